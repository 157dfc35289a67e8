#include "types/medial_axis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "types/axis_sheets.hpp"
#include "types/polygon_edges.hpp"

namespace ballflow::geometry {
namespace {

using Edge = std::array<std::int32_t, 2>;

Edge undirected(std::int32_t a, std::int32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// Sides of polygons, each once, ascending.
std::vector<Edge> polygon_sides(const MedialAxis& axis) {
  std::vector<Edge> sides;
  sides.reserve(axis.polygon_vertices.size() / 2 + 1);
  for_each_polygon_edge(axis, no_monitor(),
                        [&sides](const Edge& edge, std::span<const PolygonSide>) { sides.push_back(edge); });
  return sides;
}

std::string broken_polygon(const MedialAxis& axis, std::size_t i) {
  const std::string name = "polygon " + std::to_string(i);
  const auto corners = axis.polygon(i);
  if (corners.size() < 3)
    return name + " has " + std::to_string(corners.size()) + " corners, a polygon has at least 3";
  for (const std::int32_t v : corners) {
    if (v < 0 || static_cast<std::size_t>(v) >= axis.vertices.size()) {
      return name + " has corner " + std::to_string(v) + ", there are " +
             std::to_string(axis.vertices.size()) + " vertices";
    }
  }
  std::vector<std::int32_t> sorted(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) return name + " passes twice through vertex " + std::to_string(*twice);
  if (axis.polygon_kinds[i] > static_cast<std::uint8_t>(AxisKind::wall)) {
    return name + " has the unknown kind " + std::to_string(axis.polygon_kinds[i]);
  }
  return {};
}

/// What is wrong with directions of polygons and labels of sheets and seams; all else is right.
std::string broken_labels(const MedialAxis& axis) {
  const AxisSheets right = axis_sheets(axis);
  const auto differ = [](const auto& found, const auto& expected, const std::string& values,
                         const std::string& elements) -> std::string {
    if (found.size() != expected.size()) {
      return std::to_string(found.size()) + " " + values + ", there are " + std::to_string(expected.size()) +
             " " + elements;
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (found[i] != expected[i]) return values + " are wrong at " + std::to_string(i);
    }
    return {};
  };
  for (const std::string& broken :
       {differ(axis.polygon_sheets, right.polygon_sheets, "sheets of polygons", "polygons"),
        differ(axis.sheet_orientable, right.sheet_orientable, "marks of orientable sheets", "sheets"),
        differ(axis.seams, right.seams, "seams", "edges of three and more polygons"),
        differ(axis.seam_degrees, right.seam_degrees, "degrees of seams", "seams"),
        differ(axis.seam_curves, right.seam_curves, "curves of seams", "seams")}) {
    if (!broken.empty()) return broken;
  }
  const auto turned = std::find(right.turned.begin(), right.turned.end(), 1);
  if (turned == right.turned.end()) return {};
  return "polygon " + std::to_string(turned - right.turned.begin()) +
         " faces another way than its neighbours in its sheet";
}

}  // namespace

AxisTopology axis_topology(const MedialAxis& axis) {
  std::vector<Edge> edges = polygon_sides(axis);
  const auto sides = static_cast<std::ptrdiff_t>(edges.size());
  edges.reserve(edges.size() + axis.edges.size());
  for (const Edge& e : axis.edges) edges.push_back(undirected(e[0], e[1]));
  std::sort(edges.begin() + sides, edges.end());
  std::inplace_merge(edges.begin(), edges.begin() + sides, edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

  DisjointSets connected(axis.vertices.size());
  AxisTopology topology;
  topology.components = static_cast<std::int64_t>(axis.vertices.size());
  for (const Edge& e : edges) topology.components -= connected.join(e[0], e[1]) ? 1 : 0;
  topology.euler_characteristic = static_cast<std::int64_t>(axis.vertices.size()) -
                                  static_cast<std::int64_t>(edges.size()) +
                                  static_cast<std::int64_t>(axis.polygons());
  return topology;
}

std::string broken_invariant(const MedialAxis& axis) {
  const std::size_t n = axis.vertices.size();
  if (axis.radii.size() != n) {
    return std::to_string(n) + " vertices but " + std::to_string(axis.radii.size()) + " radii";
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_finite(axis.vertices[i])) return "vertex " + std::to_string(i) + " is not finite";
    if (!std::isfinite(axis.radii[i]) || axis.radii[i] < 0) {
      return "vertex " + std::to_string(i) + " has radius " + std::to_string(axis.radii[i]);
    }
  }
  if (axis.polygon_offsets.size() != axis.polygons() + 1) {
    return std::to_string(axis.polygons()) + " polygon kinds but " +
           std::to_string(axis.polygon_offsets.size()) + " polygon offsets, there must be one more";
  }
  if (axis.polygon_offsets[0] != 0 ||
      axis.polygon_offsets.back() != static_cast<std::int64_t>(axis.polygon_vertices.size())) {
    return "polygon offsets run from " + std::to_string(axis.polygon_offsets[0]) + " to " +
           std::to_string(axis.polygon_offsets.back()) + ", there are " +
           std::to_string(axis.polygon_vertices.size()) + " corners";
  }
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    if (axis.polygon_offsets[i] > axis.polygon_offsets[i + 1]) {
      return "polygon " + std::to_string(i) + " ends before it begins";
    }
  }
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    std::string broken = broken_polygon(axis, i);
    if (!broken.empty()) return broken;
  }
  const std::vector<Edge> sides = polygon_sides(axis);
  std::vector<Edge> seen;
  seen.reserve(axis.edges.size());
  for (std::size_t i = 0; i < axis.edges.size(); ++i) {
    const Edge e = axis.edges[i];
    const std::string name = "edge " + std::to_string(i);
    for (const std::int32_t v : e) {
      if (v < 0 || static_cast<std::size_t>(v) >= n) {
        return name + " has end " + std::to_string(v) + ", there are " + std::to_string(n) + " vertices";
      }
    }
    if (e[0] == e[1]) return name + " joins vertex " + std::to_string(e[0]) + " to itself";
    seen.push_back(undirected(e[0], e[1]));
    if (std::binary_search(sides.begin(), sides.end(), seen.back())) return name + " is a side of a polygon";
  }
  std::sort(seen.begin(), seen.end());
  const auto twice = std::adjacent_find(seen.begin(), seen.end());
  if (twice != seen.end()) {
    return "edge " + std::to_string((*twice)[0]) + ", " + std::to_string((*twice)[1]) + " is listed twice";
  }
  return broken_labels(axis);
}

MedialAxis with_sheets(MedialAxis axis, Monitor& monitor) {
  AxisSheets sheets = axis_sheets(axis, monitor);
  std::vector<std::int32_t> corners(axis.polygon_vertices.begin(), axis.polygon_vertices.end());
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    if (sheets.turned[i] == 0) continue;  // turning over keeps the first corner
    std::reverse(corners.begin() + axis.polygon_offsets[i] + 1,
                 corners.begin() + axis.polygon_offsets[i + 1]);
  }
  axis.polygon_vertices = std::move(corners);
  axis.polygon_sheets = std::move(sheets.polygon_sheets);
  axis.sheet_orientable = std::move(sheets.sheet_orientable);
  axis.seams = std::move(sheets.seams);
  axis.seam_degrees = std::move(sheets.seam_degrees);
  axis.seam_curves = std::move(sheets.seam_curves);
  return axis;
}

}  // namespace ballflow::geometry
