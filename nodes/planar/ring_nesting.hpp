// Closed chains of points become polygons: which contains which, and that they do not cross.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec2.hpp"
#include "types/polygon2.hpp"

namespace ballflow::geometry {

enum class RingRole : std::uint8_t {
  open,   // the source does not say: nesting decides
  outer,  // said to bound a component
  hole,   // said to bound a hole
};

/// A ring as a file has it: in either direction, the first point repeated at the end or not.
struct RawRing {
  std::vector<Vec2> points;
  RingRole role = RingRole::open;
  std::string name;  // "ring 2 (line 17)": for messages
};

struct NestedRings {
  Polygon2 polygon;
  std::int64_t repeated_points =
      0;                          // equal to the one before them, and left out; the closing ones not counted
  std::int64_t turned_rings = 0;  // ran the other way round
};

/// A ring inside an odd number of others bounds a hole, one inside an even number a component (the even-odd
/// rule). Components are in the order of their outer rings, the holes of one in their own order; rings begin
/// with their first point.
///
/// Everything is decided exactly for the doubles given, in time O(n log n).
///
/// Throws InputError for points that are not finite or beyond 1e100, rings of fewer than three distinct
/// points or without area, rings that cross or touch themselves or each other, naming both edges and the
/// place, and for roles that nesting contradicts. Overlapping and equal rings cross or touch.
NestedRings nest(std::vector<RawRing> rings, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
