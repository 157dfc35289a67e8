#include "refine/start_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "base/arctangent.hpp"
#include "base/disjoint_sets.hpp"
#include "base/lists.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Vec3 area_vector(const TriangleMesh& mesh, std::size_t t) {
  const auto [a, b, c] = mesh.triangles[t];
  const Vec3 p = mesh.vertices[at(a)];
  return cross(mesh.vertices[at(b)] - p, mesh.vertices[at(c)] - p);
}

struct SharpEdge {
  std::array<std::int32_t, 2> ends;
  std::int32_t triangle;  // one of those at the edge
};

std::vector<SharpEdge> sharp_edges(const TriangleMesh& mesh, double least_turn) {
  struct Side {
    std::array<std::int32_t, 2> edge;  // ascending
    std::int32_t triangle;
    bool forwards;
  };
  std::vector<Side> sides;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corner = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t u = corner[k], v = corner[(k + 1) % 3];
      sides.push_back({{std::min(u, v), std::max(u, v)}, static_cast<std::int32_t>(t), u < v});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::pair(a.edge, a.triangle) < std::pair(b.edge, b.triangle);
  });
  std::vector<SharpEdge> sharp;
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    if (last - first == 2) {
      const Vec3 a = area_vector(mesh, at(sides[first].triangle));
      Vec3 b = area_vector(mesh, at(sides[first + 1].triangle));
      if (sides[first].forwards == sides[first + 1].forwards) b = -b;  // they do not face one way
      const double norms = length(a) * length(b);
      if (!(norms > 0) || dot(a, b) >= cosine(least_turn) * norms) continue;
    }
    sharp.push_back({sides[first].edge, sides[first].triangle});
  }
  return sharp;
}

/// Walks along sharp edges, and leaves a point wherever it has gone `spacing` since the last one.
class SharpLines {
 public:
  SharpLines(const TriangleMesh& mesh, const StartPointsOptions& options, std::vector<SurfacePoint>& points)
      : mesh_(mesh), edges_(sharp_edges(mesh, options.sharp * std::numbers::pi / 180)), points_(points) {
    spacing_ = options.spacing * bounding_box(mesh.vertices.span()).longest_edge();
    turn_ = cosine(options.sharp * std::numbers::pi / 180);
    at_vertex_ = lists_of<std::int32_t>(mesh.vertices.size(), [&](auto&& put) {
      for (std::size_t e = 0; e < edges_.size(); ++e) {
        for (const std::int32_t v : edges_[e].ends) put(at(v), static_cast<std::int32_t>(e));
      }
    });
    done_.assign(edges_.size(), false);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      if (at_vertex_[v].empty() || !is_corner(v)) continue;
      points_.push_back({mesh.vertices[v], edges_[at(at_vertex_[v][0])].triangle, 0});
      for (const std::int32_t e : at_vertex_[v]) walk(v, e);
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {  // loops without a corner
      if (done_[e]) continue;
      const std::size_t v = at(edges_[e].ends[0]);
      points_.push_back({mesh.vertices[v], edges_[e].triangle, 0});
      walk(v, static_cast<std::int32_t>(e));
    }
  }

 private:
  std::size_t other_end(std::int32_t edge, std::size_t v) const {
    const auto& ends = edges_[at(edge)].ends;
    return at(ends[0]) == v ? at(ends[1]) : at(ends[0]);
  }
  bool is_corner(std::size_t v) const {
    const auto edges = at_vertex_[v];
    if (edges.size() != 2) return true;
    const Vec3 in = mesh_.vertices[v] - mesh_.vertices[other_end(edges[0], v)];
    const Vec3 out = mesh_.vertices[other_end(edges[1], v)] - mesh_.vertices[v];
    return dot(in, out) < turn_ * length(in) * length(out);
  }
  /// From v along `edge` to the next corner, or around a loop.
  void walk(std::size_t v, std::int32_t edge) {
    double gone = 0;  // since the last point
    while (!done_[at(edge)]) {
      done_[at(edge)] = true;
      const std::size_t w = other_end(edge, v);
      const Vec3 from = mesh_.vertices[v], to = mesh_.vertices[w];
      const double step = distance(from, to);
      for (double t = spacing_ - gone; t < step && spacing_ > 0; t += spacing_) {
        points_.push_back({from + (t / step) * (to - from), edges_[at(edge)].triangle, 0});
      }
      gone = std::fmod(gone + step, spacing_);
      if (is_corner(w)) return;
      const auto next = at_vertex_[w];
      edge = next[0] == edge ? next[1] : next[0];
      v = w;
    }
  }

  const TriangleMesh& mesh_;
  std::vector<SharpEdge> edges_;
  Lists<std::int32_t> at_vertex_;
  std::vector<bool> done_;
  double spacing_ = 0, turn_ = 0;
  std::vector<SurfacePoint>& points_;
};

/// Leaves the first point in every cube of the given edge.
void thin(double edge, std::vector<SurfacePoint>& points) {
  if (!(edge > 0)) return;
  using Cube = std::array<double, 3>;
  std::vector<std::pair<Cube, std::size_t>> cubes;
  cubes.reserve(points.size());
  for (const SurfacePoint& p : points) {
    cubes.push_back(
        {{std::floor(p.point.x / edge), std::floor(p.point.y / edge), std::floor(p.point.z / edge)},
         cubes.size()});
  }
  std::sort(cubes.begin(), cubes.end());
  std::vector<bool> kept(points.size(), false);
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    if (i == 0 || cubes[i].first != cubes[i - 1].first) kept[cubes[i].second] = true;
  }
  std::size_t place = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (kept[i]) points[place++] = points[i];
  }
  points.resize(place);
}

/// The vertices of every connected piece that are farthest to either side along the axes.
void add_extremes(const TriangleMesh& mesh, std::vector<SurfacePoint>& points) {
  DisjointSets pieces(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    pieces.join(t[0], t[1]);
    pieces.join(t[0], t[2]);
  }
  using Extremes = std::array<SurfacePoint, 6>;
  std::vector<Extremes> extremes(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::int32_t v : mesh.triangles[t]) {
      const Vec3 p = mesh.vertices[at(v)];
      Extremes& own = extremes[at(pieces.root(v))];
      const auto take = [&](std::size_t side, double value, double best) {
        if (own[side].triangle < 0 || value > best) own[side] = {p, static_cast<std::int32_t>(t), 0};
      };
      take(0, p.x, own[0].point.x);
      take(1, -p.x, -own[1].point.x);
      take(2, p.y, own[2].point.y);
      take(3, -p.y, -own[3].point.y);
      take(4, p.z, own[4].point.z);
      take(5, -p.z, -own[5].point.z);
    }
  }
  for (const Extremes& own : extremes) {
    if (own[0].triangle >= 0) points.insert(points.end(), own.begin(), own.end());
  }
}

/// Centroids of the triangles that lie at even steps of the area.
void add_spread(const TriangleMesh& mesh, std::size_t count, std::vector<SurfacePoint>& points) {
  std::vector<double> area_up_to;
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    area += length(area_vector(mesh, t));
    area_up_to.push_back(area);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double place = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * area;
    const auto found = std::lower_bound(area_up_to.begin(), area_up_to.end(), place) - area_up_to.begin();
    const std::size_t t = std::min(static_cast<std::size_t>(found), area_up_to.size() - 1);
    const auto [a, b, c] = mesh.triangles[t];
    const Vec3 sum = mesh.vertices[at(a)] + mesh.vertices[at(b)] + mesh.vertices[at(c)];
    points.push_back({1.0 / 3 * sum, static_cast<std::int32_t>(t), 0});
  }
}

}  // namespace

std::vector<SurfacePoint> start_points(const TriangleMesh& mesh, const StartPointsOptions& options) {
  std::vector<SurfacePoint> points;
  if (mesh.triangles.empty()) return points;
  SharpLines(mesh, options, points);
  thin(options.thinning * bounding_box(mesh.vertices.span()).longest_edge(), points);
  add_extremes(mesh, points);
  add_spread(mesh, options.spread, points);
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.point < b.point; });
  const auto same = [](const auto& a, const auto& b) { return a.point == b.point; };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  return points;
}

}  // namespace ballflow::geometry
