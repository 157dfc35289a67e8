// Exact decisions about balls: which have a point in common, and which lie in the way of others.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Predicates on the orthogonal spheres of up to four balls |x - centers[i]|^2 <= weights[i], given by their
/// indices. The smallest orthogonal sphere (c, R^2) of a set of balls is defined in alpha_shape.hpp. Every
/// answer is exact for the doubles given: most are found in double arithmetic with a bound of its error, most
/// of the others with twice as many bits, what is zero by CGAL's predicates.
///
/// Where three balls or four are asked for, their centres are not collinear or coplanar; two centres differ.
class BallPredicates {
 public:
  BallPredicates(std::span<const Vec3> centers, std::span<const double> weights);

  /// R^2 <= 0: the balls have a point in common on the intersection of their bisectors.
  bool meets(const std::array<std::int32_t, 4>& balls) const;
  bool meets(const std::array<std::int32_t, 3>& balls) const;
  bool meets(const std::array<std::int32_t, 2>& balls) const;

  /// |c - c_other|^2 - w_other < R^2: ball `other` keeps the balls from being a Gabriel simplex.
  bool attaches(const std::array<std::int32_t, 3>& balls, std::int32_t other) const;
  bool attaches(const std::array<std::int32_t, 2>& balls, std::int32_t other) const;
  bool attaches(std::int32_t ball, std::int32_t other) const;

 private:
  struct Ball {
    Vec3 center;
    double weight = 0;
  };
  const Ball& ball(std::int32_t i) const { return balls_[static_cast<std::size_t>(i)]; }

  std::vector<Ball> balls_;
  bool ordinary_ = true;  // no coordinate beyond 1e20, no weight beyond 1e40: double arithmetic is tried
};

/// A point with a weight: a ball by its centre and squared radius.
struct WeightedPoint {
  Vec3 center;
  double weight = 0;
};

/// Whether t has a negative (1) or a positive (-1) power to the sphere that is orthogonal to p, q, r and s,
/// which are positively oriented; for negatively oriented ones the other way round. 0 where doubles, and
/// twice as many bits, do not tell: nearly always because the power is 0 or the centres are coplanar. No
/// coordinate is beyond 1e20 and no weight beyond 1e40.
int quick_power_side(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                     const WeightedPoint& s, const WeightedPoint& t);

}  // namespace ballflow::geometry
