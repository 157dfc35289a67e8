#include "minkowski/minkowski_sum_2.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "minkowski/ball_tree.hpp"
#include "minkowski_cases.hpp"

namespace ballflow::geometry {
namespace {

constexpr MinkowskiAlgorithm2 plane_algorithms[] = {
    MinkowskiAlgorithm2::filtered, MinkowskiAlgorithm2::quadratic, MinkowskiAlgorithm2::hierarchical};

Numbers flat(Numbers set) {
  for (auto& ball : set) ball[2] = 0;
  return set;
}

/// By all algorithms of the plane, which agree with each other and with the sum in space.
MinkowskiSum2 plane_sum(const Numbers& a, const Numbers& b) {
  const MinkowskiSum in_space = minkowski_sum(balls_of(a), balls_of(b));
  MinkowskiSum2 sum;
  for (const MinkowskiAlgorithm2 algorithm : plane_algorithms) {
    sum = minkowski_sum_2(balls_of(a), balls_of(b), {algorithm});
    EXPECT_EQ(broken_invariant(sum.report), "");
    EXPECT_EQ(sum.balls.centers, in_space.balls.centers) << "algorithm " << static_cast<int>(algorithm);
    EXPECT_EQ(sum.balls.radii, in_space.balls.radii) << "algorithm " << static_cast<int>(algorithm);
    EXPECT_EQ(sum.report.count, in_space.report.count);
    EXPECT_EQ(sum.report.lower, in_space.report.lower);
    EXPECT_EQ(sum.report.upper, in_space.report.upper);
  }
  return sum;
}

TEST(minkowski_sum_2, is_the_sum_in_space_of_balls_in_the_plane) {
  RandomBalls random(11);
  for (int round = 0; round < 3000; ++round) {
    SCOPED_TRACE(round);
    plane_sum(flat(random(10)), flat(random(10)));
    if (HasFailure()) return;
  }
}

TEST(minkowski_sum_2, agrees_on_larger_sets) {
  RandomBalls random(12);
  for (int round = 0; round < 8; ++round) {
    SCOPED_TRACE(round);
    Numbers a(150), b(90);
    for (Numbers* set : {&a, &b}) {
      for (auto& ball : *set) {
        ball = {random.uniform(0, 4), random.uniform(0, 4), 0, random.uniform(0, 0.5)};
        if (round % 2 == 0) {
          for (double& x : ball) x = std::round(8 * x) / 8;  // ties
        }
        if (round % 4 == 3) ball[0] += 1e6;  // coordinates that round
      }
    }
    const MinkowskiSum2 sum = plane_sum(a, b);
    EXPECT_GT(sum.report.count, 10);
    EXPECT_GT(minkowski_sum_2(balls_of(a), balls_of(b), {MinkowskiAlgorithm2::hierarchical}).avoided, 0);
    EXPECT_LT(minkowski_sum_2(balls_of(a), balls_of(b)).report.survivors, sum.report.pairs);
    EXPECT_EQ(minkowski_sum_2(balls_of(b), balls_of(a)).balls.centers, sum.balls.centers);
  }
}

TEST(minkowski_sum_2, of_nothing_of_one_and_on_a_line) {
  EXPECT_EQ(plane_sum({}, {{0, 0, 0, 1}}).balls.size(), 0u);
  EXPECT_EQ(plane_sum({{1, 2, 0, 1}}, {{3, -4, 0, 0.5}}).balls.size(), 1u);
  EXPECT_EQ(plane_sum({{0, 0, 0, 0}}, {{0, 0, 0, 0}}).balls.size(), 1u);
  Numbers line, parallel;
  for (int i = 0; i < 9; ++i) {
    line.push_back({2.0 * i, 1.0 * i, 0, 0.25 * (i % 3)});
    parallel.push_back({4.0 * i, 2.0 * i, 0, 0.5});
  }
  EXPECT_GT(plane_sum(line, parallel).balls.size(), 9u);
}

TEST(minkowski_sum_2, counts_the_discs_with_an_arc_on_the_outline) {
  // Nine discs on a grid that leave nothing of the one in the middle outside, and a hole that they do.
  Numbers grid;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) grid.push_back({1.0 * x, 1.0 * y, 0, 0.625});
  }
  EXPECT_EQ(plane_sum(grid, {{0, 0, 0, 0.125}}).report.touching_boundary, 8);
  EXPECT_EQ(plane_sum(grid, {{0, 0, 0, 0}}).report.touching_boundary, 9) << "holes between four discs";
  // By angles that no other disc covers.
  RandomBalls random(13);
  for (int round = 0; round < 300; ++round) {
    Numbers set(12);
    for (auto& disc : set) disc = {random.uniform(0, 4), random.uniform(0, 4), 0, random.uniform(0.2, 1)};
    std::int64_t touching = 0;
    for (const auto& disc : set) {
      bool free = false;
      for (int k = 0; k < 20'000 && !free; ++k) {
        const double angle = k * 6.283185307179586 / 20'000;
        const double x = disc[0] + disc[3] * std::cos(angle), y = disc[1] + disc[3] * std::sin(angle);
        free = std::none_of(set.begin(), set.end(), [&](const auto& other) {
          return &other != &disc && std::hypot(x - other[0], y - other[1]) < other[3];
        });
      }
      touching += free;
    }
    ASSERT_EQ(plane_sum(set, {{0, 0, 0, 0}}).report.touching_boundary, touching) << "round " << round;
  }
}

TEST(minkowski_sum_2, bounds_the_error_by_what_was_compared) {
  const Balls disc = balls_of({{0, 0, 0, 1}}), line = balls_of({{0, 0, 0, 1}, {1, 0, 0, 1}});
  const OutlineComparison near{.a_to_b_at_least = 0.125, .a_to_b_at_most = 0.25, .b_to_a_at_most = 9},
      nearer{.a_to_b_at_most = 0.125};
  const auto bound = [&](const Balls& a, PolygonComparisons of) {
    const MinkowskiReport report = minkowski_sum_2(a, disc, {}, no_monitor(), of).report;
    EXPECT_EQ(broken_invariant(report), "");
    return report.error_bound;
  };
  for (const Balls* a : {&disc, &line}) {
    EXPECT_EQ(bound(*a, {}), -1);
    EXPECT_EQ(bound(*a, {.a = &near}), 0.25);
    EXPECT_EQ(bound(*a, {.a = &near, .b = &nearer}), 0.375);
  }
  const OutlineComparison wrong{.a_to_b_at_least = 1};
  EXPECT_THROW(minkowski_sum_2(disc, disc, {}, no_monitor(), {.a = &wrong}), InputError);
}

TEST(minkowski_sum_2, refuses_balls_in_space) {
  try {
    minkowski_sum_2(balls_of({{0, 0, 0, 1}}), balls_of({{0, 0, 0, 1}, {0, 0, 1, 1}}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("input b: ball 1 has its center at z = 1"), std::string::npos)
        << error.what();
  }
}

TEST(ball_tree, has_every_disc_once_in_bounds_that_contain_it) {
  RandomBalls random(14);
  for (int round = 0; round < 200; ++round) {
    const Balls discs = balls_of(flat(random(60)));
    const std::vector<BallTreeNode> tree = ball_tree(discs, 4);
    std::int64_t leaves = 0;
    for (std::size_t i = 0; i < tree.size(); ++i) {
      const BallTreeNode& node = tree[i];
      std::vector<Ball> below;
      for (auto k = static_cast<std::int32_t>(i); k < node.next; ++k) {
        const BallTreeNode& inner = tree[static_cast<std::size_t>(k)];
        if (inner.children >= 0) continue;
        below.insert(below.end(), inner.balls.begin(), inner.balls.end());
      }
      ASSERT_EQ(node.count, static_cast<std::int64_t>(below.size()));
      for (const Ball& disc : below) {
        ASSERT_LE(distance(disc.center, node.bound.center) + disc.radius, node.bound.radius);
        ASSERT_LE(disc.radius, node.largest.radius);
      }
      if (node.children < 0) leaves += static_cast<std::int64_t>(below.size());
    }
    ASSERT_EQ(leaves, static_cast<std::int64_t>(discs.size()));
  }
}

}  // namespace
}  // namespace ballflow::geometry
