// The one definition of "sample s lies in ball b" behind the covering matrix, its check and every bound
// drawn from it. All of them use these lines, so they agree to the last bit.
#pragma once

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// s lies in the ball of centre c and radius r iff |c - s|^2 <= r^2 (1 + 2^-30), in double arithmetic and in
/// the order of operations below. The slack, 4.7e-10 r in length, absorbs the rounding of a radius that was
/// computed as a distance; a radius of 0 has none. It is far above the error of evaluating the formula
/// (about 2^-50 r^2) and, for r up to the size L of the model, below 1e-9 L. Samples that define a ball are
/// in it whatever this predicate says; callers add them.
inline constexpr double membership_slack = 0x1p-30;

inline double squared_reach(double radius) { return radius * radius * (1 + membership_slack); }

/// `x`, `y`, `z` are the differences of the coordinates. Rounding is monotone, so replacing a difference by
/// a larger one never lowers the result: bounds by boxes decide as the points inside them would.
inline double squared_norm(double x, double y, double z) { return x * x + y * y + z * z; }

inline bool in_reach(Vec3 center, double squared_reach_of_ball, Vec3 sample) {
  return squared_norm(center.x - sample.x, center.y - sample.y, center.z - sample.z) <= squared_reach_of_ball;
}

}  // namespace ballflow::geometry
