#include "balls/power_growth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "growth_cases.hpp"
#include "power/gabriel_points.hpp"
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

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> squared_radii(const Balls& balls) {
  std::vector<double> weights;
  for (const double r : balls.radii) weights.push_back(r * r);
  return weights;
}

/// Solves a m x m system by elimination; false when it is singular.
bool solve(std::vector<std::vector<double>> a, std::vector<double>& x) {
  const std::size_t m = a.size();
  for (std::size_t i = 0; i < m; ++i) {
    std::size_t pivot = i;
    for (std::size_t k = i; k < m; ++k) {
      if (std::abs(a[k][i]) > std::abs(a[pivot][i])) pivot = k;
    }
    if (std::abs(a[pivot][i]) < 1e-12) return false;
    std::swap(a[i], a[pivot]);
    std::swap(x[i], x[pivot]);
    for (std::size_t k = 0; k < m; ++k) {
      if (k == i) continue;
      const double f = a[k][i] / a[i][i];
      for (std::size_t j = i; j < m; ++j) a[k][j] -= f * a[i][j];
      x[k] -= f * x[i];
    }
  }
  for (std::size_t i = 0; i < m; ++i) x[i] /= a[i][i];
  return true;
}

/// Critical Gabriel points straight from the definition, over all pairs, triples and quadruples: no
/// triangulation.
std::vector<Vec3> all_critical_points(const Balls& balls) {
  const std::size_t n = balls.size();
  const std::vector<double> w = squared_radii(balls);
  std::vector<Vec3> points;
  const auto look_at = [&](const std::vector<std::size_t>& s) {
    // z = c0 + sum l_i (c_i - c0) with equal powers to all of s.
    const std::size_t m = s.size() - 1;
    const Vec3 o = balls.centers[s[0]];
    std::vector<std::vector<double>> gram(m, std::vector<double>(m));
    std::vector<double> l(m);
    for (std::size_t i = 0; i < m; ++i) {
      const Vec3 u = balls.centers[s[i + 1]] - o;
      for (std::size_t j = 0; j < m; ++j) gram[i][j] = dot(u, balls.centers[s[j + 1]] - o);
      l[i] = (squared_length(u) - w[s[i + 1]] + w[s[0]]) / 2;
    }
    if (!solve(gram, l)) return;
    Vec3 z = o;
    double rest = 1;
    for (std::size_t i = 0; i < m; ++i) {
      if (l[i] < 0) return;
      rest -= l[i];
      z = z + l[i] * (balls.centers[s[i + 1]] - o);
    }
    if (rest < 0) return;
    const double power = squared_distance(z, o) - w[s[0]];
    if (power <= 0) return;
    for (std::size_t b = 0; b < n; ++b) {
      if (squared_distance(z, balls.centers[b]) - w[b] < power - 1e-12) return;
    }
    points.push_back(z);
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      look_at({i, j});
      for (std::size_t k = j + 1; k < n; ++k) {
        look_at({i, j, k});
        for (std::size_t m = k + 1; m < n; ++m) look_at({i, j, k, m});
      }
    }
  }
  std::sort(points.begin(), points.end());
  return points;
}

/// The algorithm of the thesis step by step: grow all weights until a ball touches a point or has what is
/// wished; every growing ball that touches it ceases; go on with the others.
std::vector<double> grow_step_by_step(const Balls& balls, const std::vector<double>& wished,
                                      const std::vector<Vec3>& points) {
  const std::size_t n = balls.size();
  const std::vector<double> w = squared_radii(balls);
  std::vector<double> radii(n, -1);
  double t = 0;
  for (std::size_t growing = n; growing > 0;) {
    double next = infinity;
    for (std::size_t b = 0; b < n; ++b) {
      if (radii[b] >= 0) continue;
      next = std::min(next, wished[b] * wished[b] - w[b]);
      for (const Vec3& g : points) next = std::min(next, squared_distance(g, balls.centers[b]) - w[b]);
    }
    t = std::max(t, next);
    for (std::size_t b = 0; b < n; ++b) {
      if (radii[b] >= 0) continue;
      bool ceases = wished[b] * wished[b] - w[b] <= t + 1e-13;
      for (const Vec3& g : points)
        ceases = ceases || squared_distance(g, balls.centers[b]) - w[b] <= t + 1e-13;
      if (!ceases) continue;
      radii[b] = std::sqrt(w[b] + t);
      --growing;
    }
  }
  return radii;
}

/// a is stopped at once by d; without it, b and c meet below a and close a ring.
Balls counterexample() {
  return {{{0, .5, 0}, {-1, 0, 0}, {1, 0, 0}, {0, .92, 0}}, {.3, .9, .9, .1}, {}, {}};
}

TEST(power_growth, of_the_counterexample_to_the_thesis_keeps_the_topology) {
  const Balls balls = counterexample();
  ASSERT_EQ(betti(balls), (Betti{2, 0, 0}));
  // As the thesis has it, b and c go on growing until they meet: a tunnel appears.
  const std::vector<double> wished(4, 2.0);
  const auto points = all_critical_points(balls);
  const std::vector<double> naive = grow_step_by_step(balls, wished, points);
  EXPECT_NEAR(naive[0], .31, .011);  // a touches d's point, 0.01 beyond its sphere
  EXPECT_NE(betti(with_radii(balls, naive)), betti(balls));
  // At t = .195, squared radius 1.005, before anybody has ceased but a and d.
  std::vector<double> then = naive;
  then[1] = then[2] = std::sqrt(.81 + .195);
  EXPECT_EQ(betti(with_radii(balls, then))[1], 1);

  const PowerGrowth grown = power_growth(balls, wished, exactly);
  EXPECT_EQ(betti(with_radii(balls, grown.radii)), betti(balls));
  EXPECT_EQ(grown.betti_after, (Betti{2, 0, 0}));
  EXPECT_GT(grown.unions, 1);
  EXPECT_GT(
      std::count(grown.stops.begin(), grown.stops.end(), static_cast<std::uint8_t>(GrowthStop::neighbour)),
      0);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_GE(grown.radii[i], balls.radii[i]);
  EXPECT_GT(grown.radii[0], balls.radii[0]);
}

TEST(power_growth, finds_the_critical_points_that_the_definition_has) {
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Balls balls = random_balls(4 + static_cast<int>(seed) % 10, 0.3, seed);
    const auto points = critical_gabriel_points(power_diagram(balls, {}, no_monitor()), no_monitor());
    const auto expected = all_critical_points(balls);
    ASSERT_EQ(points.size(), expected.size()) << seed;
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LT(distance(points[i], expected[i]), 1e-10) << seed;
    found += points.size();
  }
  EXPECT_GT(found, 300u);
}

TEST(power_growth, finds_critical_points_of_centers_in_a_plane_and_on_a_line) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const bool line : {false, true}) {
      const Balls space = random_balls(8, 0.2, seed);
      std::vector<Vec3> centers;
      for (const Vec3& c : space.centers) centers.push_back({c.x, line ? 0 : c.y, 0});
      const Balls balls{centers, space.radii, {}, {}};
      const PowerDiagram diagram = power_diagram(balls, {}, no_monitor());
      ASSERT_EQ(diagram.dimension, line ? 1 : 2);
      const auto points = critical_gabriel_points(diagram, no_monitor());
      const auto expected = all_critical_points(balls);
      ASSERT_EQ(points.size(), expected.size()) << seed << line;
      for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT(distance(points[i], expected[i]), 1e-10);
    }
  }
}

TEST(power_growth, is_the_algorithm_of_the_thesis_step_by_step_where_that_keeps_the_topology) {
  int at_once = 0, spread = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const Balls balls = random_balls(5 + static_cast<int>(seed) % 9, 0.3, seed);
    const std::vector<double> wished = larger(balls, 0.2 * static_cast<double>(seed % 5 + 1));
    const auto points = all_critical_points(balls);
    const std::vector<double> expected = grow_step_by_step(balls, wished, points);
    const PowerGrowth grown = power_growth(balls, wished, exactly);
    const bool kept = betti(with_radii(balls, expected)) == betti(balls);
    // Closed balls of the oracle touch at the points: where that decides, unions differ by rounding.
    if (grown.unions == 1) {
      ++at_once;
      for (std::size_t i = 0; i < balls.size(); ++i) EXPECT_NEAR(grown.radii[i], expected[i], 1e-9) << seed;
    } else {
      ++spread;
      EXPECT_FALSE(kept) << seed;
      for (std::size_t i = 0; i < balls.size(); ++i) EXPECT_LE(grown.radii[i], expected[i] + 1e-9) << seed;
    }
    EXPECT_EQ(betti(with_radii(balls, grown.radii)), betti(balls)) << seed;
    EXPECT_EQ(grown.betti_after, grown.betti_before);
    for (std::size_t i = 0; i < balls.size(); ++i) {
      EXPECT_GE(grown.radii[i], balls.radii[i]);
      EXPECT_LE(grown.radii[i], wished[i]);
      for (const Vec3& g : points) EXPECT_LT(grown.radii[i], distance(g, balls.centers[i]));
    }
  }
  EXPECT_GT(at_once, 20);
  EXPECT_GT(spread, 0);
}

TEST(power_growth, stops_two_balls_before_they_meet_and_says_so) {
  const Balls balls{{{0, 0, 0}, {4, 0, 0}, {0, 50, 0}}, {1, 1, 1}, {}, {}};
  const PowerGrowth grown = power_growth(balls, std::vector<double>{5, 1.5, 3}, exactly);
  EXPECT_LT(grown.radii[0], 2);
  EXPECT_NEAR(grown.radii[0], 2, 1e-11);
  EXPECT_EQ(grown.radii[1], 1.5);
  EXPECT_EQ(grown.radii[2], 3);
  EXPECT_EQ(grown.stops[0], static_cast<std::uint8_t>(GrowthStop::gabriel));
  EXPECT_EQ(grown.stops[1], static_cast<std::uint8_t>(GrowthStop::wish));
  EXPECT_EQ(grown.limits[0], grown.radii[0]);
  EXPECT_EQ(grown.unions, 1);
}

/// Balls of radius 0.3 around a circle of radius 1, and all around a sphere.
Balls ring() {
  std::vector<Vec3> centers;
  for (int i = 0; i < 16; ++i)
    centers.push_back({std::cos(i * 0.3926990817), std::sin(i * 0.3926990817), 0.01 * (i % 3)});
  return {centers, std::vector<double>(16, 0.3), {}, {}};
}
Balls shell() {
  std::vector<Vec3> centers;
  for (int i = 0; i < 200; ++i) {
    const double z = (2 * i + 1) / 200.0 - 1, turn = 2.399963 * i, r = std::sqrt(1 - z * z);
    centers.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  return {centers, std::vector<double>(200, 0.25), {}, {}};
}

TEST(power_growth, never_closes_a_tunnel_or_fills_a_cavity) {
  for (const Balls& balls : {ring(), shell()}) {
    const PowerGrowth grown = power_growth(balls, larger(balls, 2), exactly);
    EXPECT_NE(betti(with_radii(balls, larger(balls, 2))), betti(balls));
    EXPECT_EQ(betti(with_radii(balls, grown.radii)), betti(balls));
    double least = infinity;
    for (std::size_t i = 0; i < balls.size(); ++i) least = std::min(least, grown.radii[i] - balls.radii[i]);
    EXPECT_GT(least, 0.3);  // there is room for that
  }
}

TEST(power_growth, by_nothing_returns_the_input) {
  const Balls balls = random_balls(30, 0.2, 3);
  const PowerGrowth grown = power_growth(balls, balls.radii, exactly);
  EXPECT_EQ(Array<double>(grown.radii), balls.radii);
  EXPECT_EQ(std::count(grown.stops.begin(), grown.stops.end(), 0), 30);
}

TEST(power_growth, of_bad_sets_of_balls_keeps_the_topology_and_shrinks_nothing) {
  Random random(5);
  const auto line = [&](int n, Vec3 along) {
    std::vector<Vec3> centers;
    std::vector<double> radii;
    for (int i = 0; i < n; ++i) {
      centers.push_back(10 * random() * along);
      radii.push_back(0.3 * random());
    }
    return Balls{centers, radii, {}, {}};
  };
  std::vector<Vec3> plane, grid;
  std::vector<double> wide;
  for (int i = 0; i < 40; ++i) {
    plane.push_back({random(), random(), 2});
    wide.push_back(std::ldexp(1.0, -i));  // 12 orders of magnitude
  }
  for (int i = 0; i < 27; ++i) grid.push_back({i % 3 + 0.0, i / 3 % 3 + 0.0, i / 9 + 0.0});
  const std::vector<Balls> sets = {
      {},
      {{{1, 2, 3}}, {0.5}, {}, {}},
      {{{1, 2, 3}}, {0}, {}, {}},
      {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 1, 0.5}, {}, {}},
      {{{0, 0, 0}, {0.1, 0, 0}, {5, 0, 0}, {5, 0.2, 0}, {0, 0.1, 0.1}}, {2, 0.3, 1, 0.1, 0.2}, {}, {}},
      line(20, {1, 0, 0}),
      line(20, {0.3, 0.7, -0.2}),
      {plane, std::vector<double>(40, 0.05), {}, {}},
      {grid, std::vector<double>(27, 0.0), {}, {}},
      {grid, std::vector<double>(27, 0.5), {}, {}},  // all touch
      {grid, std::vector<double>(27, 0.6), {}, {}},
      {plane, wide, {}, {}},
      {random_balls(40, 1, 8).centers, wide, {}, {}},
  };
  for (std::size_t k = 0; k < sets.size(); ++k) {
    for (const double by : {0.001, 0.3, 100.0}) {
      const PowerGrowth grown = power_growth(sets[k], larger(sets[k], by), exactly);
      ASSERT_EQ(grown.radii.size(), sets[k].size());
      EXPECT_EQ(betti(with_radii(sets[k], grown.radii)), betti(sets[k])) << k << " " << by;
      for (std::size_t i = 0; i < sets[k].size(); ++i) {
        EXPECT_GE(grown.radii[i], sets[k].radii[i]);
        EXPECT_LE(grown.radii[i], sets[k].radii[i] + by);
      }
    }
  }
}

TEST(power_growth, refuses_radii_whose_squares_overflow) {
  EXPECT_THROW(
      power_growth({{{0, 0, 0}, {1, 0, 0}}, {1e200, 1}, {}, {}}, std::vector<double>{1e200, 1}, exactly),
      InputError);
}

}  // namespace
}  // namespace ballflow::geometry
