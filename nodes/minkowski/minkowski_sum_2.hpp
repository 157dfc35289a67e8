// The Minkowski sum of two unions of discs (thesis, 5.4).
#pragma once

#include "minkowski/minkowski_sum.hpp"
#include "types/outline_comparison.hpp"

namespace ballflow::geometry {

/// How the sums that contribute are found. All ways give the same discs.
enum class MinkowskiAlgorithm2 {
  filtered,      // pairs are streamed through a filter that drops what lies inside another sum
  quadratic,     // all pairs in one regular triangulation: algo_sq of the thesis
  hierarchical,  // down trees of circumscribed discs: algo_h, without insertion and removal
};

struct MinkowskiSum2Options {
  MinkowskiAlgorithm2 algorithm = MinkowskiAlgorithm2::filtered;
  MinkowskiKeep keep = MinkowskiKeep::contributing;
};

/// How far the polygons that the discs stand for (a of the comparison) are from a polygon inside the union of
/// the discs (b); null: not at all.
struct PolygonComparisons {
  const OutlineComparison* a = nullptr;
  const OutlineComparison* b = nullptr;
};

struct MinkowskiSum2 {
  Balls balls;  // ascending by center, z = 0
  MinkowskiReport report;
  // Algorithm hierarchical: pairs below nodes of the tree that contribute nothing, never looked at.
  std::int64_t avoided = 0;
};

/// minkowski_sum of balls with z = 0: the same balls, from a triangulation of the plane.
/// `touching_boundary` counts discs with an arc of their circle on the outline of the union, and what is kept
/// as `minimal` has the same union in the plane: in space the balls may need more.
/// No point of the boundary of the sum of the polygons is farther than the error_bound of the report from the
/// sum of the unions: it is p + q with p and q on the boundaries of both, whose distances from a polygon
/// inside the union were compared (a_to_b_at_most); see error_bound. Unknown where nothing was compared.
/// Throws InputError as minkowski_sum does, and for a center with z other than 0.
MinkowskiSum2 minkowski_sum_2(const Balls& a, const Balls& b, const MinkowskiSum2Options& options = {},
                              Monitor& monitor = no_monitor(), const PolygonComparisons& of = {});

}  // namespace ballflow::geometry
