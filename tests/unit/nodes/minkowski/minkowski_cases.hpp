// Sets of balls for Minkowski sums.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "minkowski/minkowski_sum.hpp"

namespace ballflow::geometry {

using Numbers = std::vector<std::array<double, 4>>;  // x, y, z, r
inline constexpr MinkowskiAlgorithm algorithms[] = {MinkowskiAlgorithm::filtered, MinkowskiAlgorithm::time,
                                                    MinkowskiAlgorithm::memory,
                                                    MinkowskiAlgorithm::hierarchical};

inline Balls balls_of(const Numbers& numbers) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const auto& [x, y, z, r] : numbers) {
    centers.push_back({x, y, z});
    radii.push_back(r);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

inline Numbers numbers_of(const Balls& balls) {
  Numbers numbers;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 c = balls.centers[i];
    numbers.push_back({c.x, c.y, c.z, balls.radii[i]});
  }
  return numbers;
}

inline Numbers all_sums(const Numbers& a, const Numbers& b) {
  Numbers sums;
  for (const auto& p : a) {
    for (const auto& q : b) sums.push_back({p[0] + q[0], p[1] + q[1], p[2] + q[2], p[3] + q[3]});
  }
  return sums;
}

/// Random sets of every kind that has no general position.
class RandomBalls {
 public:
  explicit RandomBalls(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  std::uint64_t below(std::uint64_t n) { return random_() % n; }

  /// Up to `most` balls.
  Numbers operator()(std::size_t most) {
    const std::uint64_t kind = below(8);
    Numbers numbers(1 + below(most));
    const Vec3 direction{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    for (auto& [x, y, z, r] : numbers) {
      const bool grid = kind < 3;
      const auto coordinate = [&] { return grid ? static_cast<double>(below(3)) : uniform(0, 2); };
      x = coordinate(), y = coordinate(), z = coordinate();
      r = grid ? 0.5 * static_cast<double>(below(5)) : uniform(0, 1);
      if (kind == 1 || kind == 4) z = 1;  // in a plane
      if (kind == 2) y = z = 0;           // on an axis
      if (kind == 5) {                    // on a line, up to rounding
        const double t = uniform(-1, 1);
        x = t * direction.x, y = t * direction.y, z = t * direction.z;
      }
      if (kind == 6) x = y = z = 0;                 // concentric
      if (kind == 7) r = below(2) == 0 ? 0 : 0.25;  // points among balls
    }
    if (below(4) == 0) numbers.push_back(numbers.front());  // equal balls
    return numbers;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace ballflow::geometry
