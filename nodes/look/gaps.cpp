#include "look/gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

using Edge = std::array<std::int32_t, 2>;  // the smaller vertex first

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Edge edge_of(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The edges of the mesh that are there once, ascending.
std::vector<Edge> single_edges(std::vector<Edge>& edges) {
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> single;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end == i + 1) single.push_back(edges[i]);
    i = end;
  }
  return single;
}

std::vector<Rim> rims_of(const TriangleMesh& mesh, const std::vector<Edge>& open) {
  DisjointSets connected(mesh.vertices.size());
  for (const Edge& e : open) connected.join(e[0], e[1]);
  std::vector<std::int32_t> number(mesh.vertices.size(), -1);
  std::vector<Rim> rims;
  std::vector<Box> boxes;
  for (const Edge& e : open) {
    std::int32_t& rim = number[at(connected.root(e[0]))];
    if (rim < 0) {
      rim = static_cast<std::int32_t>(rims.size());
      rims.emplace_back();
      boxes.emplace_back();
    }
    ++rims[at(rim)].edges;
    rims[at(rim)].length += distance(mesh.vertices[at(e[0])], mesh.vertices[at(e[1])]);
    for (const std::int32_t v : e) boxes[at(rim)].add(mesh.vertices[at(v)]);
  }
  for (std::size_t i = 0; i < rims.size(); ++i) {
    rims[i].middle = 0.5 * (boxes[i].lower + boxes[i].upper);
    rims[i].size = boxes[i].longest_edge();
  }
  std::stable_sort(rims.begin(), rims.end(), [](const Rim& a, const Rim& b) { return a.length > b.length; });
  return rims;
}

/// Welds vertices of open edges and counts what is left open.
class Welding {
 public:
  Welding(const TriangleMesh& mesh, const std::vector<Edge>& open, Monitor& monitor)
      : look_(monitor), place_(mesh.vertices.size(), -1) {
    for (const Edge& e : open) {
      for (const std::int32_t v : e) {
        if (place_[at(v)] >= 0) continue;
        place_[at(v)] = static_cast<std::int32_t>(points_.size());
        points_.push_back(mesh.vertices[at(v)]);
      }
    }
    tree_ = BoxTree(points_, BoxTree::default_leaf_size, monitor);
    neighbours_.resize(points_.size());
    for (const Edge& e : open) {
      neighbours_[at(place_[at(e[0])])].push_back(place_[at(e[1])]);
      neighbours_[at(place_[at(e[1])])].push_back(place_[at(e[0])]);
    }
    // Only edges between two such vertices can meet another one.
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t a = place_[at(t[k])], b = place_[at(t[(k + 1) % 3])];
        if (a < 0 || b < 0) continue;
        edges_.push_back(edge_of(a, b));
        triangles_.push_back(&t - mesh.triangles.data());
      }
    }
  }

  /// The distances of at most `limit` between vertices that no open edge joins, ascending.
  std::vector<double> distances(double limit) {
    std::vector<double> result;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      look_(64);
      const auto& own = neighbours_[i];
      tree_.below(points_[i], above(limit), [&](std::size_t k) {
        const double d = distance(points_[i], points_[k]);
        if (k > i && d <= limit &&
            std::find(own.begin(), own.end(), static_cast<std::int32_t>(k)) == own.end())
          result.push_back(d);
      });
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /// Edges that are left open, and triangles that lose a corner.
  std::pair<std::int64_t, std::int64_t> left_with(double tolerance) {
    DisjointSets welded(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      look_(64);
      tree_.below(points_[i], above(tolerance), [&](std::size_t k) {
        if (k > i && distance(points_[i], points_[k]) <= tolerance)
          welded.join(static_cast<std::int32_t>(i), static_cast<std::int32_t>(k));
      });
    }
    std::int64_t vanish = 0;
    std::ptrdiff_t last = -1;  // triangle that does
    std::vector<Edge> edges;
    edges.reserve(edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Edge moved = edge_of(welded.root(edges_[i][0]), welded.root(edges_[i][1]));
      if (moved[0] != moved[1]) {
        edges.push_back(moved);
      } else if (triangles_[i] != last) {
        ++vanish;
        last = triangles_[i];
      }
    }
    return {static_cast<std::int64_t>(single_edges(edges).size()), vanish};
  }

 private:
  static double above(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

  Lookout look_;
  std::vector<std::int32_t> place_;  // per vertex of the mesh: its number here, or -1
  std::vector<Vec3> points_;
  BoxTree tree_;
  std::vector<std::vector<std::int32_t>> neighbours_;  // by open edges
  std::vector<Edge> edges_;                            // of triangles, each as often as it is there
  std::vector<std::ptrdiff_t> triangles_;              // that have them
};

}  // namespace

std::vector<Edge> open_edges(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(edge_of(t[k], t[(k + 1) % 3]));
  }
  return single_edges(edges);
}

Gaps gaps_of(const TriangleMesh& mesh, Monitor& monitor) {
  const std::vector<Edge> open = open_edges(mesh);
  Gaps gaps;
  gaps.open_edges = gaps.left = static_cast<std::int64_t>(open.size());
  if (open.empty()) return gaps;
  gaps.rims = rims_of(mesh, open);
  Welding welding(mesh, open, monitor);
  std::vector<double> lengths;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      lengths.push_back(distance(mesh.vertices[at(t[k])], mesh.vertices[at(t[(k + 1) % 3])]));
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  const std::vector<double> distances = welding.distances(*middle / 4);
  if (distances.empty()) return gaps;
  std::tie(gaps.left, gaps.vanish) = welding.left_with(distances.back());
  // A larger tolerance closes more, but where it welds what does not belong together. So the largest one is
  // not always the best; halving it finds one that is.
  std::size_t count = distances.size();
  for (std::size_t k = count / 2; k > 0; k /= 2) {
    const auto left = welding.left_with(distances[k - 1]).first;
    if (left < gaps.left) {
      gaps.left = left;
      count = k;
    }
  }
  if (gaps.left >= gaps.open_edges) return {gaps.open_edges, gaps.rims, 0, gaps.open_edges, 0};
  const auto enough =
      std::partition_point(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(count - 1),
                           [&](double tolerance) { return welding.left_with(tolerance).first > gaps.left; });
  gaps.weld = *enough;
  gaps.vanish = welding.left_with(gaps.weld).second;
  return gaps;
}

}  // namespace ballflow::geometry
