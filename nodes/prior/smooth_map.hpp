// A smooth map of space that takes labelled points where they belong, and what lies between them along.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// x -> A x + t + sum_i w_i |x - p_i|^3, the interpolant of least third derivatives through
/// `from`[i] -> `to`[i] (polyharmonic spline, Duchon 1977). Affine maps are reproduced, there is no width to
/// choose, and units do not matter.
///
/// At least 4 points, all different, not in one plane. Throws InputError where the system cannot be solved.
/// Time O(n^3) for n points: take no more than 2000. Sums run in the order of the points: the same bits.
class SmoothMap {
 public:
  SmoothMap(std::span<const Vec3> from, std::span<const Vec3> to);

  Vec3 at(Vec3 x) const;
  /// The determinant of its derivative: below 0 where the map turns space inside out.
  double volume_factor(Vec3 x) const;

 private:
  std::vector<Vec3> points_;   // by the scale, about the middle
  std::vector<Vec3> weights_;  // of the points, model units
  Vec3 constant_;
  std::array<Vec3, 3> slopes_;  // of x, y, z
  Vec3 middle_;
  double scale_ = 1;
};

}  // namespace ballflow::geometry
