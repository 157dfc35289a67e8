// The Delaunay cells whose centres are inside the solid: what bounds them, and their topology.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "refine/refined_triangulation.hpp"
#include "types/topology_table.hpp"

namespace ballflow::geometry {

/// Its dual Voronoi edge crosses the surface an odd number of times.
struct BoundaryFacet {
  std::array<std::int32_t, 3> samples;  // counter-clockwise seen from the outer cell
  RefinedTriangulation::Cell inner, outer;
};

struct InnerCells {
  std::vector<BoundaryFacet> boundary;
  // Samples at which the boundary is no surface, ascending: ends of edges with other than two facets, and
  // those whose facets are not one cycle.
  std::vector<std::int32_t> bad;
  std::vector<std::int32_t> off_boundary;  // samples of no facet, ascending
  std::vector<std::int32_t> uncovered;     // samples of no inner cell, ascending
  // Of the union of the inner cells; only where the boundary is a surface and there are inner cells.
  std::optional<Betti> betti;
};

/// Every cell must have been looked at. Numbers the cells.
InnerCells inner_cells(RefinedTriangulation& triangulation);

}  // namespace ballflow::geometry
