// The boundary of a union of discs: closed chains of arcs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/array.hpp"
#include "base/vec2.hpp"
#include "types/polygon2.hpp"

namespace ballflow::geometry {

/// Ring i is the chain of arcs ring_offsets[i] .. ring_offsets[i + 1), each from its begin to that of the
/// next, the last to that of the first, counter-clockwise around its disc: the union is on the left
/// everywhere. Component k has the rings component_offsets[k] .. component_offsets[k + 1), first the outer
/// one, then its holes. An arc that is a whole circle is a ring by itself.
struct DiscOutline {
  Array<Vec2> centers;            // of the discs that have an arc, ascending by disc, model units
  Array<double> radii;            // above 0
  Array<std::int32_t> discs;      // their numbers among the discs whose union it is
  Array<std::int32_t> arc_discs;  // of each arc: index into centers
  Array<Vec2> arc_begins;         // on its circle, up to rounding
  Array<double> arc_angles;       // how far it goes, radians in [0, 2 pi]
  Array<std::int64_t> ring_offsets, component_offsets;

  std::size_t rings() const { return ring_offsets.empty() ? 0 : ring_offsets.size() - 1; }
  std::size_t components() const { return component_offsets.empty() ? 0 : component_offsets.size() - 1; }
};

/// By formulas: right but for rounding. Of one ring: negative for holes.
double signed_area(const DiscOutline& outline, std::size_t ring);
double area(const DiscOutline& outline);
double perimeter(const DiscOutline& outline);

/// Of the union.
Box bounding_box(const DiscOutline& outline);

/// Points on the arcs of a ring, in their order, such that no point of it is farther than `error`, above 0,
/// from the chord beside it; at least four to a turn. Chords lie in the discs of their arcs, so that the
/// polygon is inside the union.
std::vector<Vec2> points_on_ring(const DiscOutline& outline, std::size_t ring, double error);

/// All rings as polygons. Those that rounding leaves fewer than three points, or turns over, are left out,
/// and with an outer ring its holes.
Polygon2 polygon_in(const DiscOutline& outline, double error);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const DiscOutline& outline);

}  // namespace ballflow::geometry
