#include "cover/lagrangian_bound.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <utility>
#include <vector>

#include "cover/cover_matrix.hpp"
#include "cover/greedy.hpp"
#include "cover/reduce.hpp"
#include "cover/share_bound.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

using test::Sets;
using test::state_of;

constexpr auto how_certified = static_cast<std::uint8_t>(BoundHow::certified);

TEST(lagrangian_bound, never_exceeds_the_optimum_and_its_certificate_holds_on_the_original_matrix) {
  std::mt19937 random(51);
  int closed = 0;
  for (int round = 0; round < 2000; ++round) {
    const std::size_t rows = 3 + random() % 10, columns = 3 + random() % 16;
    const CoverState original =
        state_of(test::random_sets(random, rows, columns, 0.1 + 0.4 * test::unit(random)), columns);
    const std::int64_t best = test::optimum(original);
    for (const bool reduced : {false, true}) {
      const CoverState bounded = lagrangian_bound(reduced ? reduce(original) : original);
      ASSERT_EQ(broken_invariant(bounded), "");
      ASSERT_EQ(test::certificate_error(original, bounded), "");
      ASSERT_LE(bounded.lower_bound, best);
      ASSERT_EQ(bounded.lower_bound, bounded.certified_bound());
      ASSERT_EQ(bounded.lower_bound_how, how_certified);
      closed += bounded.lower_bound == best ? 1 : 0;
    }
  }
  EXPECT_GT(closed, 3600);  // the relaxation is tight for most instances of this size
}

TEST(lagrangian_bound, reaches_the_bound_of_linear_programming_on_odd_cycles) {
  // n samples in a ring, each ball covers two neighbours: the relaxation is n / 2, rounded up (n + 1) / 2.
  for (const std::int32_t n : {3, 5, 9, 31, 101}) {
    Sets rows;
    for (std::int32_t i = 0; i < n; ++i) {
      rows.push_back({std::min(i, (i + 1) % n), std::max(i, (i + 1) % n)});
    }
    const CoverState state = state_of(rows, static_cast<std::size_t>(n));
    EXPECT_EQ(lagrangian_bound(state).lower_bound, (n + 1) / 2) << n;
  }
}

TEST(lagrangian_bound,
     stays_below_the_optimum_of_steiner_triples_where_relaxation_and_optimum_are_far_apart) {
  // The seven lines of the Fano plane are to be met by points: 3 points, relaxation 7 / 3. Two independent
  // planes prove 3 each.
  const Sets plane{{0, 1, 2}, {0, 3, 4}, {0, 5, 6}, {1, 3, 5}, {1, 4, 6}, {2, 3, 6}, {2, 4, 5}};
  EXPECT_EQ(lagrangian_bound(state_of(plane, 7)).lower_bound, 3);
  Sets two = plane;
  for (auto row : plane) {
    for (std::int32_t& c : row) c += 7;
    two.push_back(row);
  }
  EXPECT_EQ(lagrangian_bound(state_of(two, 14)).lower_bound, 6);
}

TEST(lagrangian_bound, is_at_least_the_share_bound_and_keeps_what_is_better) {
  std::mt19937 random(52);
  int better = 0;
  for (int round = 0; round < 300; ++round) {
    const CoverState state = reduce(state_of(test::random_sets(random, 80, 120, 0.05), 120));
    const CoverState share = share_bound(state), lagrangian = lagrangian_bound(state);
    ASSERT_GE(lagrangian.lower_bound, share.lower_bound);
    better += lagrangian.lower_bound > share.lower_bound ? 1 : 0;
    const CoverState after = share_bound(lagrangian);
    ASSERT_EQ(after.lower_bound, lagrangian.lower_bound);
    ASSERT_EQ(after.certificate_prices, lagrangian.certificate_prices);
  }
  EXPECT_GT(better, 50);
}

TEST(lagrangian_bound, is_the_same_for_any_number_of_threads) {
  std::mt19937 random(53);
  Sets rows;
  for (int part = 0; part < 40; ++part) {
    for (auto row : test::random_sets(random, 25, 30, 0.12)) {
      for (std::int32_t& c : row) c += 30 * part;
      rows.push_back(row);
    }
  }
  const CoverState state = state_of(rows, 1200);
  const CoverState expected = lagrangian_bound(state);
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(test::same(lagrangian_bound(state), expected));
  }
}

TEST(lagrangian_bound, climbs_where_hundreds_of_balls_cover_each_sample) {
  // Discs in a square, 500 around each sample: the first step overloads all of them.
  std::mt19937 random(5);
  std::vector<Vec3> points, centers;
  for (int s = 0; s < 300; ++s) points.push_back({test::unit(random), test::unit(random), 0});
  for (int i = 0; i < 8000; ++i) centers.push_back({test::unit(random), test::unit(random), 0});
  PointSet samples;
  samples.points = std::move(points);
  const Balls balls{std::move(centers), std::vector<double>(8000, 0.15), {}, {}};
  const CoverState state = cover_matrix(balls, samples).cover;
  const CoverState start = lagrangian_bound(state, {.iterations = 0});
  const CoverState bounded = lagrangian_bound(state);
  EXPECT_EQ(test::certificate_error(state, bounded), "");
  EXPECT_GT(bounded.lower_bound, start.lower_bound + 1);
  EXPECT_LE(bounded.lower_bound, static_cast<std::int64_t>(greedy(state).chosen.size()));
}

TEST(lagrangian_bound, accepts_matrices_of_one_kind_only) {
  EXPECT_EQ(lagrangian_bound(state_of({}, 0)).lower_bound, 0);
  EXPECT_EQ(lagrangian_bound(state_of({{}, {}}, 0)).lower_bound, 0);
  EXPECT_EQ(lagrangian_bound(state_of({{0}, {}}, 2)).lower_bound, 1);  // nothing covers the second column
  std::vector<std::int32_t> all(500);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(lagrangian_bound(state_of(Sets(500, all), 500)).lower_bound, 1);
}

TEST(lagrangian_bound, spreads_shares_without_iterations) {
  const CoverState state = state_of({{0, 1}, {1, 2}, {0, 2}}, 3);
  EXPECT_EQ(lagrangian_bound(state, {.iterations = 0}).lower_bound, 2);
}

TEST(lagrangian_bound, stops_when_cancelled) {
  struct Impatient final : Monitor {
    bool cancelled() override { return ++looks > 10; }
    std::atomic<int> looks{0};
  } monitor;
  std::mt19937 random(54);
  const CoverState state = state_of(test::random_sets(random, 200, 300, 0.03), 300);
  EXPECT_THROW(lagrangian_bound(state, {}, monitor), Cancelled);
}

TEST(lagrangian_bound, takes_more_samples_than_16_bits_can_number) {
  // A chain: balls of two neighbours, so that the optimum is half of the samples; all have the price 1/2.
  for (const std::int32_t n : {65534, 65535, 65536, 70000}) {
    Sets rows;
    for (std::int32_t c = 0; c + 1 < n; ++c) rows.push_back({c, c + 1});
    const CoverState bounded =
        lagrangian_bound(state_of(rows, static_cast<std::size_t>(n)), {.iterations = 5});
    EXPECT_EQ(bounded.lower_bound, (n + 1) / 2) << n;
    EXPECT_EQ(test::certificate_error(state_of(rows, static_cast<std::size_t>(n)), bounded), "");
  }
}

}  // namespace
}  // namespace ballflow::geometry
