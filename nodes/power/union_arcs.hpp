// The arcs on the boundary of a union of balls, where two spheres meet, read off its dual complex.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "power/union_vertices.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// An arc of the circle in which the spheres of balls i and j meet. It runs counter-clockwise around the axis
/// from the center of i to that of j, from one boundary vertex to another, or all around.
struct UnionArc {
  std::int32_t edge = 0;  // ij, i < j: index into complex.edges
  // Exposed sides that name the vertices where it begins and ends; -1: it is a whole circle.
  std::int32_t from = -1, to = -1;
  // The third balls of these two vertices. Where they are one, the arc is a whole turn less what its two
  // vertices on either side of one triangle cut off.
  std::int32_t from_apex = -1, to_apex = -1;
  // orientation(i, j, from_apex, to_apex), decided exactly: 1 when the second apex is less than half a turn
  // ahead of the first.
  std::int8_t turn = 0;

  bool whole() const { return from < 0; }
};

/// All arcs, by edge, those of an edge in the order around it. `sides` are all exposed sides of the complex
/// (exposed_sides). Every decision is exact.
std::vector<UnionArc> union_arcs(const SimplicialComplex& complex, std::span<const ExposedSide> sides,
                                 Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
