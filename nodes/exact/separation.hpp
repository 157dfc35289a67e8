// How far two balls are apart, compared as if with real numbers.
#pragma once

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Coordinates and radii beyond this are refused by what compares separations.
inline constexpr double largest_separable = 1e140;

/// Two closed balls. Their separation is |a - b| - radius_a - radius_b: how far they are apart, 0 where they
/// touch from outside, and where they overlap the negative of their depth, the shortest way by which one can
/// be moved until they touch from outside.
struct BallPair {
  Vec3 a, b;  // centers
  double radius_a = 0, radius_b = 0;
};

/// A separation in doubles: the true one is within `error` of `value`.
struct RoughSeparation {
  double value, error;
};
inline RoughSeparation rough_separation(double distance, double radius_a, double radius_b) {
  // Three squares lose 3 parts in 2^53 each, their sum two, the root half of all and one more; every
  // subtraction one part of what is subtracted. What underflows in a square is below 1e-161 in the root.
  return {distance - radius_a - radius_b, 0x1p-50 * (distance + radius_a + radius_b) + 1e-160};
}
inline RoughSeparation rough_separation(const BallPair& p) {
  return rough_separation(distance(p.a, p.b), p.radius_a, p.radius_b);
}

/// -1, 0 or 1: the separation of p is less than that of q, equal, greater. Exact for the doubles given, which
/// are finite and at most `largest_separable`: most answers come from doubles with a bound of their error,
/// most others from twice as many bits, the rest from squaring until no root is left.
int compare_separations(const BallPair& p, const BallPair& q);

/// -1, 0 or 1: the separation of p is less than `value`, equal, greater. Exact.
int compare_separation(const BallPair& p, double value);

/// The separation as a double, off by less than the 2000th part more than half a unit of its last place; 0
/// where it is 0, and of the right sign.
double nearest_separation(const BallPair& p);
/// A double that is not above the separation, and none between.
double separation_at_least(const BallPair& p);
/// A double that is not below the separation, and none between.
double separation_at_most(const BallPair& p);

}  // namespace ballflow::geometry
