#include "motion/subtract.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "exact/separation.hpp"

namespace ballflow::geometry {
namespace {

Balls random_balls(std::mt19937& random, int n, double largest) {
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < n; ++i) {
    centers.push_back({u(random), u(random), u(random)});
    radii.push_back(largest * u(random));
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

TEST(subtract, leaves_the_largest_balls_that_reach_into_no_other) {
  std::mt19937 random(1);
  const Balls a = random_balls(random, 500, 0.2), b = random_balls(random, 300, 0.1);
  const Balls rest = subtracted(a, b, no_monitor());
  std::size_t at = 0;
  int smaller = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    double gap = HUGE_VAL;
    for (std::size_t j = 0; j < b.size(); ++j)
      gap = std::min(gap, distance(a.centers[i], b.centers[j]) - b.radii[j]);
    if (gap <= 0) continue;
    ASSERT_LT(at, rest.size());
    EXPECT_EQ(rest.centers[at], a.centers[i]);
    EXPECT_LE(rest.radii[at], a.radii[i]);
    EXPECT_NEAR(rest.radii[at], std::min(a.radii[i], gap), 1e-15);
    if (gap < a.radii[i]) ++smaller;
    ++at;
  }
  EXPECT_EQ(at, rest.size());
  EXPECT_GT(smaller, 50);
  EXPECT_LT(rest.size(), a.size());
  // Not by a rounding.
  for (std::size_t i = 0; i < rest.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j)
      ASSERT_GE(compare_separation({rest.centers[i], b.centers[j], rest.radii[i], b.radii[j]}, 0), 0);
  }
}

TEST(subtract, of_nothing_or_from_nothing_changes_nothing) {
  std::mt19937 random(2);
  const Balls a = random_balls(random, 5, 0.2);
  EXPECT_EQ(subtracted(a, {}, no_monitor()).radii, a.radii);
  EXPECT_EQ(subtracted({}, a, no_monitor()).size(), 0u);
  EXPECT_EQ(subtracted(a, a, no_monitor()).size(), 0u);
}

TEST(subtract, refuses_balls_that_are_none) {
  const Balls one{{Vec3{0, 0, 0}}, {1}, {}, {}}, bad{{Vec3{0, NAN, 0}}, {1}, {}, {}},
      far{{Vec3{2e140, 0, 0}}, {1}, {}, {}};
  EXPECT_THROW(subtracted(one, bad, no_monitor()), InputError);
  EXPECT_THROW(subtracted(bad, one, no_monitor()), InputError);
  EXPECT_THROW(subtracted(one, far, no_monitor()), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
