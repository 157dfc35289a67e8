// The Minkowski sum of two unions of balls: a union of balls again (thesis, chapter 5).
//
// Notation: a + b = (c_a + c_b, r_a + r_b) for balls a of A and b of B, the sums of doubles rounded to
// nearest; the balls of the sum are what these doubles say. The power of x to a ball is |x - c|^2 - r * r,
// with the square rounded.
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/comparison.hpp"
#include "types/minkowski_report.hpp"

namespace ballflow::geometry {

/// No point of the surface of A + B is farther than this from the sum of the unions, for two solids A and B
/// that were compared with their balls (Compare, with a closed mesh); null: A is the union of its balls
/// itself. Negative when both are null, and when one was compared with points or an open mesh, which are no
/// boundary of a solid: then nothing is known, and why_unbounded says why.
///
/// Proof. A point of the boundary of A + B is p + q with p and q on the boundaries of A and B, because p + B
/// is inside A + B for p inside A. It is as far from the sum of the unions as p and q are from theirs,
/// together, at most. And d(p, U) is at most the largest distance from a surface to the boundary of its union
/// (Comparison::surface_to_union.at_most), and at most the largest distance of a sample outside U plus the
/// distance to the next sample (uncovered + spacing); the smaller one counts. (Up to rounding: Compare takes
/// 2^-30 of the longest edge for 0.) That is h(A + B, U) <= h(A, U_A) + h(B, U_B) (thesis, 5.2) for surfaces:
/// what is deep inside a solid was not measured.
double error_bound(const Comparison* a, const Comparison* b);

/// How the sums that contribute are found. All ways give the same balls.
enum class MinkowskiAlgorithm {
  filtered,      // pairs are streamed through a filter that drops what lies inside another sum
  time,          // all pairs in one regular triangulation: algo_time of the thesis, 5.5
  memory,        // insert a pair, test it, drop it; what is left is tested again: algo_mem of the thesis
  hierarchical,  // down octrees of balls around balls of either set: 5.3.2 of the thesis
};

/// Which sums are kept.
enum class MinkowskiKeep {
  contributing,  // those that some point of theirs has a smaller power to than to all others
  minimal,       // of these a part that has the same union, none of which can go: power/minimal_union.hpp
};

struct MinkowskiSumOptions {
  MinkowskiAlgorithm algorithm = MinkowskiAlgorithm::filtered;
  MinkowskiKeep keep = MinkowskiKeep::contributing;
};

/// How far the balls are from the solids they stand for, for the error bound; null: not at all.
struct SolidComparisons {
  const Comparison* a = nullptr;
  const Comparison* b = nullptr;
};

struct MinkowskiSum {
  Balls balls;  // ascending by center: x, then y, then z
  MinkowskiReport report;
};

/// The sums a + b that contribute to the union of all: of equal sums one, and of those only the ones with a
/// point in the closed ball to which the power is strictly smaller than to all other sums (thesis, (5.1)).
/// - Their union is the Minkowski sum of the two unions, up to the rounding of a + b. A contributing ball
///   need not be visible, and the union may not need it: `keep` minimal keeps an inclusion-minimal part.
/// - The result depends on the balls alone, neither on their order, nor on which set is A, nor on the
///   algorithm. Decisions are exact.
/// - Accepts any balls: none (the sum is empty), one (an offset), equal, concentric and touching ones,
/// centers in a
///   plane or on a line, radius 0.
/// - The report has the error_bound of the comparisons `of` a and b.
/// - Throws InputError for balls and comparisons that break their invariants, for coordinates and radii that
/// are not 0 and outside
///   [1e-150, 1e150], and for more sums to triangulate than indices or the memory (base/memory.hpp) hold.
MinkowskiSum minkowski_sum(const Balls& a, const Balls& b, const MinkowskiSumOptions& options = {},
                           Monitor& monitor = no_monitor(), const SolidComparisons& of = {});

}  // namespace ballflow::geometry
