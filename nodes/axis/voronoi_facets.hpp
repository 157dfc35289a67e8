// The part of a medial axis inside the tetrahedra of the dual complex: Voronoi facets, cut at its boundary.
#pragma once

#include <cstdint>
#include <vector>

#include "axis/voronoi_places.hpp"
#include "base/monitor.hpp"
#include "types/medial_axis.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// A polygon of the axis by the names of its corners: balls, and Voronoi vertices (see VoronoiVertex::name).
struct AxisPiece {
  std::vector<std::int32_t> corners;
  AxisKind kind;
};

/// The polygons of the intersection of R and V, in no particular order; each has three corners at least.
std::vector<AxisPiece> voronoi_facets(const SimplicialComplex& complex, const VoronoiPlaces& places,
                                      Monitor& monitor);

}  // namespace ballflow::geometry
