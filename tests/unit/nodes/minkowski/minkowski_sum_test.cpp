#include "minkowski/minkowski_sum.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "contribution_oracle.hpp"
#include "minkowski/hierarchical_sums.hpp"
#include "minkowski/power_triangulation.hpp"
#include "minkowski_cases.hpp"

namespace ballflow::geometry {
namespace {

/// By all algorithms, which agree.
MinkowskiSum sum_of(const Balls& a, const Balls& b) {
  const MinkowskiSum sum = minkowski_sum(a, b);
  EXPECT_EQ(broken_invariant(sum.balls), "");
  EXPECT_EQ(broken_invariant(sum.report), "");
  EXPECT_EQ(sum.report.count, static_cast<std::int64_t>(sum.balls.size()));
  EXPECT_EQ(sum.report.pairs, static_cast<std::int64_t>(a.size() * b.size()));
  for (const MinkowskiAlgorithm algorithm : algorithms) {
    const MinkowskiSum other = minkowski_sum(a, b, {.algorithm = algorithm});
    EXPECT_EQ(other.balls.centers, sum.balls.centers) << "algorithm " << static_cast<int>(algorithm);
    EXPECT_EQ(other.balls.radii, sum.balls.radii) << "algorithm " << static_cast<int>(algorithm);
    EXPECT_EQ(other.report.touching_boundary, sum.report.touching_boundary);
    EXPECT_EQ(broken_invariant(other.report), "");
  }
  return sum;
}

Numbers sum_of(const Numbers& a, const Numbers& b) {
  return numbers_of(sum_of(balls_of(a), balls_of(b)).balls);
}

double power(Vec3 p, const std::array<double, 4>& ball) {
  return squared_distance(p, {ball[0], ball[1], ball[2]}) - ball[3] * ball[3];
}

double least_power(Vec3 p, const Numbers& balls) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& ball : balls) least = std::min(least, power(p, ball));
  return least;
}

/// All distinct sums that contribute among all others, by enumeration.
Numbers contributing(const Numbers& a, const Numbers& b) {
  Numbers sums = all_sums(a, b);
  std::sort(sums.begin(), sums.end());
  sums.erase(std::unique(sums.begin(), sums.end()), sums.end());
  const auto site = [](const std::array<double, 4>& s) { return Site{{s[0], s[1], s[2]}, s[3] * s[3]}; };
  Numbers left;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    std::vector<Site> others;
    for (std::size_t j = 0; j < sums.size(); ++j) {
      if (j != i) others.push_back(site(sums[j]));
    }
    if (test::contributes_by_enumeration(site(sums[i]), others)) left.push_back(sums[i]);
  }
  return left;
}

TEST(minkowski_sum, of_two_balls_is_a_ball) {
  EXPECT_EQ(sum_of(Numbers{{1, 2, 3, 0.5}}, Numbers{{-4, 5, 0, 0.25}}), (Numbers{{-3, 7, 3, 0.75}}));
  EXPECT_EQ(sum_of(Numbers{{1, 2, 3, 0}}, Numbers{{1, 0, 0, 0}}), (Numbers{{2, 2, 3, 0}}));
}

TEST(minkowski_sum, with_no_ball_is_empty) {
  EXPECT_EQ(sum_of(Numbers{}, Numbers{{0, 0, 0, 1}}), Numbers{});
  EXPECT_EQ(sum_of(Numbers{{0, 0, 0, 1}}, Numbers{}), Numbers{});
  EXPECT_EQ(sum_of(Numbers{}, Numbers{}), Numbers{});
}

TEST(minkowski_sum, of_negative_zeros_is_zero) {
  const Numbers sum = sum_of(Numbers{{-0.0, -0.0, 0, 1}}, Numbers{{-0.0, 0, -0.0, 1}});
  ASSERT_EQ(sum.size(), 1u);
  for (const double x : sum[0]) EXPECT_FALSE(std::signbit(x));
}

TEST(minkowski_sum, keeps_balls_that_contribute_and_are_not_needed) {
  // Four balls that cover the fifth, which is nevertheless in its own cell around the origin.
  const double r = 1.05 * std::sqrt(3.0), s = 0.33 * std::sqrt(3.0);
  const Numbers five{{-1, -1, 1, r}, {-1, 1, -1, r}, {0, 0, 0, s}, {1, -1, -1, r}, {1, 1, 1, r}};
  const MinkowskiSum sum = sum_of(balls_of(five), balls_of({{0, 0, 0, 0}}));
  EXPECT_EQ(numbers_of(sum.balls), five);
  EXPECT_EQ(sum.report.touching_boundary, 4);
}

TEST(minkowski_sum, counts_the_balls_on_the_boundary_of_the_union) {
  // A ball in the middle of a ring of six, and of a shell of 26 that leaves nothing of it outside.
  Numbers ring{{0, 0, 0, 0.75}};
  for (int k = 0; k < 6; ++k) ring.push_back({std::cos(k), std::sin(k), 0, 0.75});
  EXPECT_EQ(sum_of(balls_of(ring), balls_of({{0, 0, 0, 0.25}})).report.touching_boundary, 7);
  Numbers shell;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        shell.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z), 0.875});
      }
    }
  }
  const MinkowskiSum sum = sum_of(balls_of(shell), balls_of({{0, 0, 0, 0.125}}));
  EXPECT_EQ(sum.report.count, 27);
  EXPECT_EQ(sum.report.touching_boundary, 26);
}

TEST(minkowski_sum, contributing_sums_are_those_that_enumeration_finds) {
  RandomBalls random(3);
  for (int round = 0; round < 150; ++round) {
    SCOPED_TRACE(round);
    const Numbers a = random(3), b = random(3);
    ASSERT_EQ(sum_of(a, b), contributing(a, b));
  }
}

TEST(minkowski_sum, has_the_points_of_the_union_of_all_sums) {
  RandomBalls random(4);
  for (int round = 0; round < 2000; ++round) {
    SCOPED_TRACE(round);
    const Numbers a = random(8), b = random(8), all = all_sums(a, b);
    const MinkowskiSum found = sum_of(balls_of(a), balls_of(b));
    const Numbers sum = numbers_of(found.balls);
    ASSERT_FALSE(HasFailure());
    for (const auto& ball : sum) ASSERT_NE(std::find(all.begin(), all.end(), ball), all.end());
    // Points anywhere, and on spheres of sums, where a missing ball shows first.
    for (int k = 0; k < 20; ++k) {
      const auto& near = all[random.below(all.size())];
      const Vec3 u{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      const double reach = (k % 2 == 0 ? 1 : random.uniform(0, 1.5)) * near[3] / std::max(length(u), 1e-9);
      const Vec3 p = Vec3{near[0], near[1], near[2]} + reach * u;
      const double expected = least_power(p, all);
      // Inside the union the least power itself is that of all sums (the power diagram stays).
      if (expected < 0) {
        ASSERT_NEAR(least_power(p, sum), expected, 1e-12);
      } else {
        ASSERT_GE(least_power(p, sum), expected);
      }
    }
  }
}

TEST(minkowski_sum, hierarchical_passes_by_pairs_and_nothing_else) {
  RandomBalls random(15);
  for (int round = 0; round < 4; ++round) {
    Numbers a(40), b(300);
    for (Numbers* set : {&a, &b}) {
      for (auto& ball : *set) {
        ball = {random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 2)};
        if (round % 2 == 0) {
          for (double& x : ball) x = std::round(4 * x) / 4;  // ties
        }
      }
    }
    EXPECT_EQ(sum_of(a, b), sum_of(b, a));
    const MinkowskiReport report =
        minkowski_sum(balls_of(a), balls_of(b), {.algorithm = MinkowskiAlgorithm::hierarchical}).report;
    EXPECT_LT(report.survivors, report.pairs);
  }
}

/// Counts the questions.
struct Asked : PowerTriangulation {
  bool may_contribute(const Ball& ball) {
    const bool may = PowerTriangulation::may_contribute(ball);
    (may ? left : passed_by) += 1;
    return may;
  }
  int left = 0, passed_by = 0;
};

TEST(minkowski_sum, hierarchical_asks_the_triangulation_about_blocks_and_loses_nothing) {
  RandomBalls random(16);
  int left = 0, passed_by = 0;
  for (int round = 0; round < 40; ++round) {
    SCOPED_TRACE(round);
    Numbers a(30), b(60);
    for (Numbers* set : {&a, &b}) {
      for (auto& ball : *set) {
        ball = {random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 1)};
        if (round % 2 == 0) {
          for (double& x : ball) x = std::round(4 * x) / 4;  // ties
        }
      }
    }
    const Balls one = balls_of(a), other = balls_of(b);
    Asked triangulation;
    const std::int64_t inserted =
        HierarchicalSums(one, other, triangulation,
                         {.bytes_per_sum = 1, .bytes_per_vertex = 1, .asked_size = 1, .worth = 0})
            .run(no_monitor());
    EXPECT_LT(inserted, 1800);
    Numbers found;
    for (const Ball& ball : triangulation.contributing(no_monitor()).balls)
      found.push_back({ball.center.x, ball.center.y, ball.center.z, ball.radius});
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, numbers_of(minkowski_sum(one, other, {.algorithm = MinkowskiAlgorithm::time}).balls));
    left += triangulation.left, passed_by += triangulation.passed_by;
  }
  EXPECT_GT(left, 100);
  EXPECT_GT(passed_by, 100);
}

TEST(minkowski_sum, algorithms_agree_on_larger_sets) {
  RandomBalls random(5);
  for (int round = 0; round < 6; ++round) {
    SCOPED_TRACE(round);
    Numbers a(60), b(40);
    for (Numbers* set : {&a, &b}) {
      for (auto& ball : *set) {
        ball = {random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 1)};
        if (round % 2 == 0) {
          for (double& x : ball) x = std::round(4 * x) / 4;  // ties
        }
      }
    }
    const MinkowskiSum sum = sum_of(balls_of(a), balls_of(b));
    EXPECT_GT(sum.report.count, 10);
    EXPECT_LT(sum.report.survivors, sum.report.pairs);
  }
}

TEST(minkowski_sum, does_not_depend_on_which_set_is_first_nor_on_their_order) {
  RandomBalls random(6);
  for (int round = 0; round < 100; ++round) {
    Numbers a = random(10), b = random(10);
    const Numbers sum = sum_of(a, b);
    ASSERT_EQ(sum_of(b, a), sum);
    std::reverse(a.begin(), a.end());
    std::rotate(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(b.size() / 2), b.end());
    ASSERT_EQ(sum_of(a, b), sum);
  }
}

TEST(minkowski_sum, moves_and_scales_with_its_inputs) {
  std::mt19937_64 random(7);
  const auto digit = [&] { return static_cast<double>(random() % 64) / 16; };  // sums are exact
  for (int round = 0; round < 30; ++round) {
    Numbers a(1 + random() % 10), b(1 + random() % 10);
    for (Numbers* set : {&a, &b}) {
      for (auto& ball : *set) ball = {digit(), digit(), digit(), digit() / 4};
    }
    Numbers expected = sum_of(a, b);
    Numbers moved = a;
    for (auto& ball : moved) ball = {ball[0] + 3, ball[1] - 64, ball[2] + 0.5, ball[3]};
    Numbers moved_sum = expected;
    for (auto& ball : moved_sum) ball = {ball[0] + 3, ball[1] - 64, ball[2] + 0.5, ball[3]};
    ASSERT_EQ(sum_of(moved, b), moved_sum);
    for (const double scale : {0x1p-300, 0.25, 0x1p300}) {
      const auto scaled = [scale](Numbers set) {
        for (auto& ball : set) {
          for (double& x : ball) x *= scale;
        }
        return set;
      };
      ASSERT_EQ(sum_of(scaled(a), scaled(b)), scaled(expected));
    }
  }
}

TEST(minkowski_sum, with_a_ball_at_the_origin_adds_its_radius) {
  // Balls along a spiral, each of which keeps a part of the boundary.
  Numbers a, expected;
  for (int k = 0; k < 100; ++k) {
    const double t = 0.25 * k;
    a.push_back({3 * std::cos(t), 3 * std::sin(t), t, 0.5});
    expected.push_back({3 * std::cos(t), 3 * std::sin(t), t, 0.5 + 0.125});
  }
  std::sort(expected.begin(), expected.end());
  const MinkowskiSum sum = sum_of(balls_of(a), balls_of({{0, 0, 0, 0.125}}));
  EXPECT_EQ(numbers_of(sum.balls), expected);
  EXPECT_EQ(sum.report.touching_boundary, 100);

  RandomBalls random(8);
  for (int round = 0; round < 100; ++round) {
    Numbers set = random(12), grown = set;
    for (auto& ball : grown) ball[3] += 0.75;
    ASSERT_EQ(sum_of(set, Numbers{{0, 0, 0, 0.75}}), sum_of(grown, Numbers{{0, 0, 0, 0}}));
  }
}

TEST(minkowski_sum, does_not_depend_on_the_number_of_threads) {
  // So many pairs that they are looked at in parts, with ties: coordinates on a coarse grid.
  RandomBalls random(10);
  Numbers a(2200), b(1800);
  for (Numbers* set : {&a, &b}) {
    for (auto& ball : *set) {
      ball = {random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4), random.uniform(0.5, 1.5)};
      for (double& x : ball) x = std::round(8 * x) / 8;
    }
  }
  const auto run = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    return arena.execute([&] { return minkowski_sum(balls_of(a), balls_of(b)); });
  };
  const MinkowskiSum one = run(1);
  EXPECT_GT(one.report.survivors, one.report.count);
  for (const int threads : {2, 4}) {
    const MinkowskiSum more = run(threads);
    EXPECT_EQ(more.balls.centers, one.balls.centers);
    EXPECT_EQ(more.balls.radii, one.balls.radii);
    EXPECT_EQ(more.report.survivors, one.report.survivors) << "the filter holds what it held";
    EXPECT_EQ(more.report.touching_boundary, one.report.touching_boundary);
  }
}

TEST(minkowski_sum, needs_no_general_position_for_its_speed) {
  // A grid of balls, each of which holds a tangent one: every decision about those is exact.
  Numbers a;
  for (int k = 0; k < 512; ++k) {
    const double x = k % 8, y = k / 8 % 8, z = k / 64;
    a.push_back({x, y, z, 0.75});
    a.push_back({x + 0.25, y, z, 0.5});
  }
  const MinkowskiSum sum = sum_of(balls_of(a), balls_of({{0, 0, 0, 1}, {0, 0.5, 0, 0.5}}));
  EXPECT_EQ(sum.report.count, 512);
}

}  // namespace
}  // namespace ballflow::geometry
