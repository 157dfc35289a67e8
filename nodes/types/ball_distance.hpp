// How far two sets of balls are apart, as Distance found it.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// What the balls of one side stand for.
enum class SolidOfBalls : std::uint8_t {
  their_union = 0,  // nothing else
  enclosed = 1,  // a solid that they contain, proven, and from which they stand out by no more than a bound
  near_by = 2,   // a solid that they do not contain, with such a bound: 0 for balls inside
  unknown = 3,   // a solid of which nothing is known
};

/// The separation of two balls is how far they are apart, and where they overlap the negative of their depth
/// (exact/separation.hpp).
///
/// Where the smallest separation of all pairs is 0 or more, it is the distance of the unions. Where it is
/// negative, it is the depth of the deepest pair: no shorter translation parts the unions, but the shortest
/// that does may be longer.
struct BallDistance {
  std::int64_t balls_a = 0, balls_b = 0;

  // The pair with the smallest separation; of equal ones the first a, then the first b.
  std::int32_t a = 0, b = 0;
  double separation = 0;  // model units, rounded to the nearest
  // On the two spheres, on the line through the centers: next to each other or, where the balls overlap,
  // deepest in the other one. Rounded.
  Vec3 point_a, point_b;

  // Pairs with a separation of `threshold` or less, ascending by separation, a, b.
  double threshold = 0;                      // model units
  std::uint8_t cut = 0;                      // 1: there are more, with larger separations
  Array<std::array<std::int32_t, 2>> pairs;  // p x 2: ball of a, ball of b
  Array<double> separations;                 // p, model units
  Array<Vec3> pair_points_a, pair_points_b;  // p x 3 each, as point_a and point_b

  // Of every ball how far the other set is, and the ball of it with the smallest separation, the first of
  // equal ones; or empty.
  Array<Vec3> centers_a, centers_b;          // n x 3, m x 3, model units: the balls
  Array<double> radii_a, radii_b;            // n, m
  Array<double> clearances_a, clearances_b;  // n, m: separations, model units
  Array<std::int32_t> nearest_a, nearest_b;  // n, m

  // The distance of the solids is proven to be in between, model units, rounded outwards; at most -1:
  // unknown.
  double solids_at_least = 0, solids_at_most = 0;
  std::uint8_t a_solid = 0, b_solid = 0;  // SolidOfBalls
};

/// "0.25 apart (ball 3 of a, ball 7 of b)", "the deepest pair overlaps by 0.1 (...)", "touching (...)".
std::string describe(const BallDistance& distance);
/// What is proven about the solids; empty where they are the unions of the balls.
std::string describe_solids(const BallDistance& distance);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const BallDistance& distance);

}  // namespace ballflow::geometry
