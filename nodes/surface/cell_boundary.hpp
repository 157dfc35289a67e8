// The surface between the cells of a triangulation that are inside and those that are outside, as a closed
// 2-manifold.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/power_diagram.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A facet of a cell by the corner opposite to it.
struct CellFacet {
  std::int32_t cell = 0;  // inside
  std::uint8_t corner = 0;
};

struct CellBoundary {
  TriangleMesh mesh;  // closed, every edge in two triangles that run through it in opposite directions
  std::vector<std::int32_t> ball;   // per vertex: the ball whose centre it is, -1 for the midpoint of an edge
  std::vector<CellFacet> facets;    // per triangle: the facet that it is, or a part of
  std::int64_t split_vertices = 0;  // copies of balls' centres beyond the first
  std::int64_t midpoints = 0;
  std::int64_t specks = 0;  // components left out, smaller than `smallest_component` of the largest
};

struct CellBoundaryOptions {
  double smallest_component = 0.01;  // share of the area of the largest component
};

/// Around an edge with more than two triangles the triangles are paired across the outside between them, so
/// the inside hangs together and sheets that touch come apart; a vertex whose triangles are several fans
/// becomes several. Where two pairs run between the same two copies of vertices each gets a midpoint.
/// Triangles look away from the inside. All of them are facets of one triangulation, so none meets another
/// but at common corners, edges, and copies of them.
///
/// `inside`: per cell 1 or 0, 0 for infinite ones. The diagram is three-dimensional.
CellBoundary cell_boundary(const PowerDiagram& diagram, const std::vector<std::uint8_t>& inside,
                           const CellBoundaryOptions& options = {}, Monitor& monitor = no_monitor());

/// Leaves out components smaller than `smallest` of the area of the largest, and vertices of no triangle.
void drop_specks(CellBoundary& surface, double smallest);

}  // namespace ballflow::geometry
