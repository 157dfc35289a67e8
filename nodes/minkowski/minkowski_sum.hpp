// The Minkowski sum of two unions of balls: a union of balls again (thesis, chapter 5).
//
// Notation: a + b = (c_a + c_b, r_a + r_b) for balls a of A and b of B, the sums of doubles rounded to
// nearest; the balls of the sum are what these doubles say. The power of x to a ball is |x - c|^2 - r * r,
// with the square rounded.
#pragma once

#include "types/balls.hpp"
#include "types/minkowski_report.hpp"
#include "types/monitor.hpp"

namespace ballflow::geometry {

/// How the sums that contribute are found. All ways give the same balls.
enum class MinkowskiAlgorithm {
  filtered,  // pairs are streamed through a filter that drops what lies inside another sum
  time,      // all pairs in one regular triangulation: algo_time of the thesis, 5.5
  memory,    // insert a pair, test it, drop it; what is left is tested again: algo_mem of the thesis
};

/// Which sums are kept.
enum class MinkowskiKeep {
  contributing,  // those that some point of theirs has a smaller power to than to all others
};

struct MinkowskiSumOptions {
  MinkowskiAlgorithm algorithm = MinkowskiAlgorithm::filtered;
  MinkowskiKeep keep = MinkowskiKeep::contributing;
};

struct MinkowskiSum {
  Balls balls;  // ascending by center: x, then y, then z
  MinkowskiReport report;
};

/// The sums a + b that contribute to the union of all: of equal sums one, and of those only the ones with a
/// point in the closed ball to which the power is strictly smaller than to all other sums (thesis, (5.1)).
/// - Their union is the Minkowski sum of the two unions, up to the rounding of a + b. A contributing ball
/// need
///   not be visible, and the union may not need it: the set is not minimal.
/// - The result depends on the balls alone, neither on their order, nor on which set is A, nor on the
/// algorithm.
///   Decisions are exact.
/// - Accepts any balls: none (the sum is empty), one (an offset), equal, concentric and touching ones,
/// centers in a
///   plane or on a line, radius 0.
/// - Throws InputError for balls that break their invariants, for coordinates and radii that are not 0 and
/// outside
///   [1e-150, 1e150], and for more sums to triangulate than indices or the memory of the machine hold.
MinkowskiSum minkowski_sum(const Balls& a, const Balls& b, const MinkowskiSumOptions& options = {},
                           Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
