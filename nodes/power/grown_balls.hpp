// Balls in general position: squared radii that grew by amounts beyond every feature of the union.
//
// Ties are what is hard about a union of balls: four spheres through one point, balls that touch. If every
// squared radius grows by another tiny amount nothing is a tie any more, and below the smallest critical
// value of the union its homotopy type stays, closed balls that touch being joined before as after.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "exact/long_number.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// The balls |x - centers[i]|^2 <= weights[i] + growth of i. The growth is between one and two units and
/// depends on the ball alone, not on its number; the unit is so small that it is no feature: a critical value
/// of the union is a quotient of polynomials of the degrees 8 and 6 in coordinates of so many bits.
class GrownBalls {
 public:
  /// Keeps references. n x 3 centres and n weights, finite, weights not negative.
  GrownBalls(std::span<const Vec3> centers, std::span<const double> weights);

  std::size_t size() const { return centers_.size(); }
  Vec3 center(std::int32_t ball) const { return centers_[static_cast<std::size_t>(ball)]; }
  double weight(std::int32_t ball) const { return weights_[static_cast<std::size_t>(ball)]; }
  LongNumber grown_weight(std::int32_t ball, long bits) const;
  /// grown_weight = weight + growth * 2^unit, growth an integer below 2^33.
  double growth(std::int32_t ball) const;
  long unit() const { return unit_; }
  /// No coordinate and no radius is beyond 2^magnitude.
  long magnitude() const { return magnitude_; }
  /// Bits from the largest weight to the last bit of a growth.
  long depth() const { return 2 * magnitude_ - unit_; }

 private:
  std::span<const Vec3> centers_;
  std::span<const double> weights_;
  long unit_ = 0, magnitude_ = 0;
};

/// The dual complex of the grown balls, exactly, without classes and Betti numbers; `centers` and `weights`
/// are those of the balls before. InputError where the centres lie in a plane.
SimplicialComplex grown_complex(const GrownBalls& balls, Monitor& monitor);

}  // namespace ballflow::geometry
