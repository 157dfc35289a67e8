// Whether a ball of a union has a power cell of its own that meets it (thesis, (5.1)), decided exactly.
//
// Notation: a site is a ball (c, w), w its squared radius; the power of x to it is |x - c|^2 - w. The cell of
// a site is the set of points whose power to it is STRICTLY smaller than to all others: an open convex
// polyhedron, empty where ties leave no volume. A site contributes when a point of its closed ball, power
// <= 0, is in its cell.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace ballflow::geometry {

struct Site {
  Vec3 center;
  double weight = 0;  // squared radius, >= 0
};

/// Decides whether a site contributes among others. Reuse one object for many sites: it keeps its memory.
///
/// In coordinates y = x - c the cell is { y : d_j . y < b_j for all j }, d_j = c_j - c and
/// b_j = (|d_j|^2 - w_j + w) / 2. It has a point in the closed ball if and only if the point of
/// { d_j . y <= b_j - t } next to the origin is inside the sphere for every small t > 0: the open cell is met
/// in its interior or not at all, and a ball that touches it from outside has no point in it. (A ball of
/// radius 0 contributes when its center is in the cell.) That point is
/// found by Seidel's incremental algorithm for three variables, first with doubles: it is then checked as a
/// witness, or its multipliers as a proof that there is none, with bounds on all rounding errors. What is
/// left open is computed with rational numbers and an infinitesimal t.
class ContributionTest {
 public:
  /// `others` are all other sites, or at least the neighbours of `site` in their regular triangulation.
  /// Coordinates are within +-2e150 and weights at most 4e300, so that nothing overflows.
  bool contributes(const Site& site, std::span<const Site> others);

  /// How many decisions needed rational numbers.
  std::size_t exact_decisions() const { return exact_; }

 private:
  enum class Answer { no, yes, unknown };
  struct HalfSpace {
    Vec3 d;
    double b = 0, margin = 0;  // margin: far more than the rounding errors of d . y - b for y in the ball
  };
  Answer filtered(const Site& site, std::span<const Site> others);  // what doubles can prove
  static bool exact(const Site& site, std::span<const Site> others);

  std::vector<HalfSpace> half_spaces_;
  std::size_t exact_ = 0;
};

}  // namespace ballflow::geometry
