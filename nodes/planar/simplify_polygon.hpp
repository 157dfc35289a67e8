// Polygons with fewer corners, whose boundary hardly moves.
#pragma once

#include "base/monitor.hpp"
#include "types/polygon2.hpp"

namespace ballflow::geometry {

struct SimplifyPolygonOptions {
  double tolerance = 0.001;  // how far the boundary may move, in % of the longest edge of the bounding box
};

struct SimplifiedPolygon {
  Polygon2 polygon;
  double tolerance = 0;  // that was used, model units: neither boundary is farther from the other
  bool lowered = false;  // it is less than what was asked for: rings would have met
};

/// Leaves corners out, greedily along each ring: an edge of the result passes no corner that it replaces at
/// more than the tolerance, and reaches beyond none (sleeves of Zhao and Saalfeld 1997, with a limit to how
/// far is looked ahead). So the old chain is no farther from the edge, and as it runs from one of its ends to
/// the other, the edge no farther from the chain. What remains are corners of the input, three of each ring
/// at least.
///
/// Rings do not cross or touch afterwards, and have the same nesting, decided exactly (planar/ring_nesting):
/// where they would, the tolerance is halved for all of them; the polygon itself is the last resort.
///
/// O(n log n) for each of them. Distances are in doubles. Throws InputError for a polygon without components,
/// one that breaks its invariants or whose rings touch, and for a tolerance that is negative or not finite.
SimplifiedPolygon simplify_polygon(const Polygon2& polygon, const SimplifyPolygonOptions& options = {},
                                   Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
