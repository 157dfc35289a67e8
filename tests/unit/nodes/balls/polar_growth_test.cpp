// Growth of polar balls, which are degenerate; and of turned, permuted and scaled ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "growth_cases.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "power/power_diagram.hpp"

namespace ballflow::geometry {
namespace {

using growth_cases::Betti;
using growth_cases::betti;
using growth_cases::exactly;
using growth_cases::larger;
using growth_cases::Random;
using growth_cases::random_balls;
using growth_cases::with_radii;

/// Inner polar balls of a torus: raw, so degenerate.
const Balls& polar_balls() {
  static const Balls balls = [] {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    const int around = 40, across = 14;
    const auto id = [&](int i, int j) { return (i % around) * across + j % across; };
    Random random(11);
    for (int i = 0; i < around; ++i) {
      for (int j = 0; j < across; ++j) {
        const double u = 6.283185307179586 * (i + 0.3 * random()) / around;
        const double v = 6.283185307179586 * (j + 0.3 * random()) / across;
        const double tube = 0.25 + 0.05 * std::sin(3 * u), reach = 1 + tube * std::cos(v);
        points.push_back({reach * std::cos(u), reach * std::sin(u), tube * std::sin(v)});
        triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
        triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
      }
    }
    return label_poles(voronoi_poles({points, {}}, {}), {points, triangles}, {}).inner;
  }();
  return balls;
}

TEST(power_growth, of_polar_balls_adds_the_tolerance_and_keeps_the_tunnel) {
  const Balls& balls = polar_balls();
  ASSERT_GT(balls.size(), 300u);
  const PowerGrowth grown = power_growth(balls, larger(balls, 0.9), {AlphaTolerance::polar});
  EXPECT_EQ(grown.betti_before, (Betti{1, 1, 0}));
  EXPECT_EQ(betti(with_radii(balls, grown.radii)), (Betti{1, 1, 0}));
  EXPECT_NE(betti(with_radii(balls, larger(balls, 0.9))), (Betti{1, 1, 0}));
  double mean = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    EXPECT_GT(grown.radii[i], balls.radii[i]);
    mean += (grown.radii[i] - balls.radii[i]) / static_cast<double>(balls.size());
  }
  EXPECT_GT(mean, 0.1);
}

TEST(power_growth, takes_the_power_diagram_of_the_balls_and_no_other) {
  const Balls balls = polar_balls();
  const std::vector<double> wished = larger(balls, 0.1);
  for (const AlphaTolerance tolerance : {AlphaTolerance::polar, AlphaTolerance::none}) {
    const PowerDiagram diagram = power_diagram(balls, {tolerance}, no_monitor());
    const PowerGrowth alone = power_growth(balls, wished, {tolerance});
    EXPECT_EQ(power_growth(balls, wished, {tolerance}, no_monitor(), &diagram).radii, alone.radii);
    const AlphaTolerance other =
        tolerance == AlphaTolerance::polar ? AlphaTolerance::none : AlphaTolerance::polar;
    EXPECT_THROW(power_growth(balls, wished, {other}, no_monitor(), &diagram), InputError);
  }
}

TEST(power_growth, of_permuted_mirrored_and_scaled_balls_is_permuted_mirrored_and_scaled) {
  for (const bool polar : {false, true}) {
    const Balls balls = polar ? polar_balls() : random_balls(60, 0.2, 21);
    const PowerGrowthOptions options{polar ? AlphaTolerance::polar : AlphaTolerance::none};
    const std::size_t n = balls.size();
    const double by = polar ? 0.9 : 0.3;
    const PowerGrowth grown = power_growth(balls, larger(balls, by), options);
    ASSERT_GT(n - static_cast<std::size_t>(std::count(grown.stops.begin(), grown.stops.end(), 0)), 5u);
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), std::mt19937(3));
    std::vector<Vec3> centers;
    std::vector<double> radii, wished;
    for (const std::size_t i : order) {
      const Vec3 c = balls.centers[i];
      centers.push_back({-8 * c.x, 8 * c.y, 8 * c.z});
      radii.push_back(8 * balls.radii[i]);
      wished.push_back(8 * (balls.radii[i] + by));
    }
    const PowerGrowth other = power_growth({centers, radii, {}, {}}, wished, options);
    EXPECT_EQ(other.unions, grown.unions);
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(other.radii[i], 8 * grown.radii[order[i]]) << i;
      ASSERT_EQ(other.limits[i], 8 * grown.limits[order[i]]) << i;
      ASSERT_EQ(other.stops[i], grown.stops[order[i]]) << i;
    }
  }
}

TEST(power_growth, of_turned_balls_is_the_same_but_for_rounding) {
  const Balls balls = random_balls(60, 0.2, 22);
  const PowerGrowth grown = power_growth(balls, larger(balls, 0.3), exactly);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  Vec3 u{2.8, 2.2, -0.2}, v{-1.6, 2.6, 1.8};
  u = 1 / length(u) * u;
  v = v - dot(u, v) * u;
  v = 1 / length(v) * v;
  const Vec3 w = cross(u, v);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 c = balls.centers[i];
    centers.push_back(3.5 * (c.x * u + c.y * v + c.z * w));
    radii.push_back(3.5 * balls.radii[i]);
  }
  const Balls turned{centers, radii, {}, {}};
  const PowerGrowth other = power_growth(turned, larger(turned, 3.5 * 0.3), exactly);
  EXPECT_EQ(other.betti_before, grown.betti_before);
  EXPECT_EQ(other.unions, grown.unions);
  for (std::size_t i = 0; i < balls.size(); ++i) EXPECT_NEAR(other.radii[i], 3.5 * grown.radii[i], 1e-9) << i;
}

TEST(power_growth, stops_when_cancelled) {
  struct Impatient final : Monitor {
    bool cancelled() override { return true; }
  } impatient;
  EXPECT_THROW(power_growth(polar_balls(), larger(polar_balls(), 0.1), {}, impatient), Cancelled);
}

}  // namespace
}  // namespace ballflow::geometry
