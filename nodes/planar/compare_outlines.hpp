// The difference of two polygons.
#pragma once

#include "base/monitor.hpp"
#include "types/outline_comparison.hpp"
#include "types/polygon2.hpp"

namespace ballflow::geometry {

struct CompareOutlinesOptions {
  double spacing =
      0.1;  // % of the longest edge of the bounding box of a: samples on boundaries are no farther apart
};

/// - Areas are those of the exact overlay (CGAL's rational arrangement): every polygon counts as it is. Where
/// rings of one cross or touch, as outlines of discs may that meet in a point, nothing has an area for
/// certain: a warning says where, and areas are unknown.
/// - Distances are measured from samples on the edges, corners among them, to the nearest edge; between two
/// samples the distance changes at most as much as places, which makes at_most.
///
/// Accepts polygons without components. Throws InputError for polygons that break their invariants, for one
/// that is empty where the other is not, for options out of range, and for more than 2^26 samples.
OutlineComparison compare_outlines(const Polygon2& a, const Polygon2& b,
                                   const CompareOutlinesOptions& options = {},
                                   Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
