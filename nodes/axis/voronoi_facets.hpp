// The part of a medial axis inside the tetrahedra of the dual complex: Voronoi facets, cut at its boundary.
#pragma once

#include <array>
#include <cstdint>
#include <span>
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
  bool needless = false;                      // between boundary vertices that are one but for rounding
  std::array<std::int32_t, 2> sites{-1, -1};  // w0 and w1 of a facet between V(w0) and V(w1)
};

/// The polygons of the intersection of R and V, in no particular order; each has three corners at least.
std::vector<AxisPiece> voronoi_facets(const SimplicialComplex& complex, const VoronoiPlaces& places,
                                      Monitor& monitor);

/// Whether the pieces are what the theory says: with the triangles of w, those of every w close around a
/// polytope. (Every side is there an even number of times.) Where rounding has put one thing on the wrong
/// side of another, some cell is open, though all Betti numbers may be right by chance.
bool cells_are_closed(const SimplicialComplex& complex, const UnionVertices& sites,
                      std::span<const AxisPiece> pieces, Monitor& monitor);

}  // namespace ballflow::geometry
