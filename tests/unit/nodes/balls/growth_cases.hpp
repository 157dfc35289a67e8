// Balls that grow, and the topology of their union.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "balls/power_growth.hpp"
#include "power/alpha_shape.hpp"

namespace ballflow::geometry::growth_cases {

inline constexpr PowerGrowthOptions exactly{AlphaTolerance::none};
using Betti = std::array<std::int64_t, 3>;

inline Betti betti(const Balls& balls) { return alpha_shape(balls, {}, no_monitor()).betti; }

inline Balls with_radii(const Balls& balls, const std::vector<double>& radii) {
  Balls result = balls;
  result.radii = radii;
  return result;
}

inline std::vector<double> larger(const Balls& balls, double by) {
  std::vector<double> radii;
  for (const double r : balls.radii) radii.push_back(r + by);
  return radii;
}

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}
  double operator()() { return static_cast<double>(random_()) / 4294967296.0; }

 private:
  std::mt19937 random_;
};

inline Balls random_balls(int n, double largest, unsigned seed) {
  Random random(seed);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < n; ++i) {
    const double x = random(), y = random(), z = random();
    centers.push_back({x, y, z});
    radii.push_back(largest * random());
  }
  return {centers, radii, {}, {}};
}

}  // namespace ballflow::geometry::growth_cases
