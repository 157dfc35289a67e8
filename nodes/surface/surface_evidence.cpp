#include "surface/surface_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/for_each_block.hpp"
#include "search/surface_tree.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::array<std::int32_t, 3> balls_of(const PowerDiagram& diagram, const CellFacet& facet) {
  std::array<std::int32_t, 3> balls{};
  for (std::size_t j = 0, n = 0; j < 4; ++j) {
    if (j != facet.corner) balls[n++] = diagram.cells[at(facet.cell)][j];
  }
  return balls;
}

double area_of(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.vertices[at(t[0])], b = mesh.vertices[at(t[1])], c = mesh.vertices[at(t[2])];
  return 0.5 * length(cross(b - a, c - a));
}

/// The largest set of balls that are `left` (1) and hang together: edges of the triangulation join them where
/// they meet.
void find_patch(const PowerDiagram& diagram, const std::vector<std::uint8_t>& left,
                const std::vector<double>& distance, SurfaceEvidence& evidence) {
  DisjointSets patches(left.size());
  const auto meet = [&](std::size_t a, std::size_t b) {
    return geometry::distance(diagram.centers[a], diagram.centers[b]) <=
           std::sqrt(diagram.weights[a]) + std::sqrt(diagram.weights[b]);
  };
  for (const auto& cell : diagram.cells) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (cell[j] < 0 || left[at(cell[j])] == 0) continue;
      for (std::size_t k = j + 1; k < 4; ++k) {
        if (cell[k] >= 0 && left[at(cell[k])] == 1 && meet(at(cell[j]), at(cell[k])))
          patches.join(cell[j], cell[k]);
      }
    }
  }
  struct Patch {
    std::int64_t size = 0;
    double farthest = 0;
    Vec3 place = {};
  };
  std::map<std::int32_t, Patch> by_root;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i] == 0) continue;
    Patch& patch = by_root[patches.root(static_cast<std::int32_t>(i))];
    ++patch.size;
    if (distance[i] > patch.farthest || (distance[i] == patch.farthest && diagram.centers[i] < patch.place)) {
      patch.farthest = distance[i];
      patch.place = diagram.centers[i];
    }
  }
  Patch largest;
  for (const auto& [root, patch] : by_root) {
    if (std::tie(patch.size, patch.farthest) > std::tie(largest.size, largest.farthest)) largest = patch;
  }
  evidence.left_out_patch = largest.size;
  evidence.patch_at = largest.place;
}

/// Balls that the surface passes by.
void find_left_out(const PowerDiagram& diagram, const TriangleMesh& mesh, SurfaceEvidence& evidence,
                   Monitor& monitor) {
  const std::size_t n = diagram.centers.size();
  std::vector<double> distance(n, 0);
  const SurfaceTree tree(mesh, monitor);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for_each_block(n, 1024, monitor, 0, 1, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto nearest = tree.nearest(diagram.centers[i], infinity);
      distance[i] = nearest ? nearest->distance : infinity;
    }
  });
  double all = 0, missed = 0;
  std::vector<std::uint8_t> left(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    all += diagram.weights[i];
    if (distance[i] * distance[i] <= diagram.weights[i]) continue;
    left[i] = 1;
    ++evidence.left_out;
    missed += diagram.weights[i];
    evidence.farthest = std::max(evidence.farthest, distance[i]);
  }
  evidence.left_out_area = all > 0 ? missed / all : 0;
  if (evidence.left_out > 0) find_patch(diagram, left, distance, evidence);
}

/// Gives every fan of triangles at a vertex a vertex of its own, and leaves out what no triangle has.
void separate_fans(CellBoundary& surface) {
  const std::vector<Triangle> triangles(surface.mesh.triangles.begin(), surface.mesh.triangles.end());
  DisjointSets corners(3 * triangles.size());
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t>
      half_edges;  // directed; corner where it begins
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) half_edges[{triangles[i][k], triangles[i][(k + 1) % 3]}] = 3 * i + k;
  }
  const auto next = [](std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  for (const auto& [edge, corner] : half_edges) {
    const auto other = half_edges.find({edge.second, edge.first});
    if (other == half_edges.end()) continue;
    corners.join(static_cast<std::int32_t>(corner), static_cast<std::int32_t>(next(other->second)));
    corners.join(static_cast<std::int32_t>(next(corner)), static_cast<std::int32_t>(other->second));
  }
  std::vector<std::int32_t> number(3 * triangles.size(), -1), ball;
  std::vector<std::uint8_t> seen(surface.mesh.vertices.size(), 0);
  std::vector<Vec3> vertices;
  std::vector<Triangle> renumbered(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t old = at(triangles[i][k]);
      std::int32_t& vertex = number[at(corners.root(static_cast<std::int32_t>(3 * i + k)))];
      if (vertex < 0) {
        vertex = static_cast<std::int32_t>(vertices.size());
        vertices.push_back(surface.mesh.vertices[old]);
        ball.push_back(surface.ball[old]);
        if (seen[old] == 1) ++surface.split_vertices;
        seen[old] = 1;
      }
      renumbered[i][k] = vertex;
    }
  }
  surface.mesh = {std::move(vertices), std::move(renumbered)};
  surface.ball = std::move(ball);
}

}  // namespace

double facet_gap(const PowerDiagram& diagram, const CellFacet& facet) {
  const std::array<std::int32_t, 3> balls = balls_of(diagram, facet);
  const Vec3 p = diagram.centers[at(balls[0])];
  const Vec3 u = diagram.centers[at(balls[1])] - p, v = diagram.centers[at(balls[2])] - p;
  const double w = diagram.weights[at(balls[0])];
  // The centre p + x u + y v has one power to all three balls.
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v);
  const double f = (uu + w - diagram.weights[at(balls[1])]) / 2;
  const double g = (vv + w - diagram.weights[at(balls[2])]) / 2;
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return std::numeric_limits<double>::infinity();
  const Vec3 center = (f * vv - g * uv) / determinant * u + (g * uu - f * uv) / determinant * v;
  return std::sqrt(std::max(0.0, dot(center, center) - w));
}

SurfaceEvidence surface_evidence(const PowerDiagram& diagram, const CellLabels& labels,
                                 const CellBoundary& surface, const std::vector<double>& spacing, double hole,
                                 Monitor& monitor) {
  SurfaceEvidence evidence;
  const std::size_t m = surface.mesh.triangles.size();
  evidence.filled.assign(m, 0);
  evidence.overruled.assign(m, 0);
  double all = 0, filled = 0, open = 0;
  for (std::size_t i = 0; i < m; ++i) {
    const CellFacet& facet = surface.facets[i];
    const std::size_t inner = at(facet.cell), outer = at(diagram.neighbors[inner][facet.corner]);
    const double area = area_of(surface.mesh, surface.mesh.triangles[i]);
    all += area;
    evidence.overruled[i] = labels.contradicted[inner] == 1 || labels.contradicted[outer] == 1 ? 1 : 0;
    if ((diagram.in_complex[inner] >> facet.corner & 1) != 0) continue;
    filled += area;
    double radius = 0, around = 0;  // means of the three
    for (const std::int32_t ball : balls_of(diagram, facet)) {
      radius += std::sqrt(diagram.weights[at(ball)]) / 3;
      around += spacing[at(ball)] / 3;
    }
    evidence.filled[i] = facet_gap(diagram, facet) > hole * std::max(radius, around) ? 2 : 1;
    if (evidence.filled[i] == 2) open += area;
  }
  if (all > 0) {
    evidence.filled_area = filled / all;
    evidence.wide_area = open / all;
  }
  find_left_out(diagram, surface.mesh, evidence, monitor);
  return evidence;
}

CellBoundary without_holes(const CellBoundary& surface, const std::vector<std::uint8_t>& filled,
                           double smallest_hole, double smallest_component) {
  const auto& triangles = surface.mesh.triangles;
  DisjointSets patches(triangles.size());
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> at_edge;  // one of the filled triangles
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (filled[i] == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [other, is_new] =
          at_edge.try_emplace(std::minmax(triangles[i][k], triangles[i][(k + 1) % 3]), i);
      // Gaps grow from wide ones only: a net of small gaps may reach all over a surface.
      if (!is_new && (filled[i] == 2 || filled[other->second] == 2))
        patches.join(static_cast<std::int32_t>(i), static_cast<std::int32_t>(other->second));
    }
  }
  std::vector<double> area(triangles.size(), 0);
  std::vector<std::uint8_t> wide(triangles.size(), 0);
  double all = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const double own = area_of(surface.mesh, triangles[i]);
    all += own;
    const std::size_t root = at(patches.root(static_cast<std::int32_t>(i)));
    area[root] += own;
    wide[root] |= filled[i] == 2 ? 1 : 0;
  }
  CellBoundary open = surface;
  std::vector<Triangle> kept;
  std::vector<CellFacet> facets;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t root = at(patches.root(static_cast<std::int32_t>(i)));
    if (wide[root] == 1 && area[root] >= smallest_hole * all) continue;
    kept.push_back(triangles[i]);
    facets.push_back(surface.facets[i]);
  }
  open.mesh.triangles = std::move(kept);
  open.facets = std::move(facets);
  separate_fans(open);
  drop_specks(open, smallest_component);
  return open;
}

}  // namespace ballflow::geometry
