#include "cover/large_cover_matrix.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <string>

#include "cover/greedy.hpp"
#include "cover/ip_solve.hpp"
#include "cover/lagrangian_bound.hpp"
#include "cover/local_search.hpp"
#include "cover/reduce.hpp"
#include "cover/sample_counts.hpp"
#include "cover/share_bound.hpp"
#include "cover/verify_cover.hpp"
#include "cover_oracle.hpp"
#include "search/membership.hpp"

namespace ballflow::geometry {
namespace {

bool covers(const Balls& balls, std::size_t i, const PointSet& points, std::size_t s) {
  const auto defining = balls.samples_of(i);
  return in_reach(balls.centers[i], squared_reach(balls.radii[i]), points.points[s]) ||
         std::find(defining.begin(), defining.end(), static_cast<std::int32_t>(s)) != defining.end();
}

/// Random balls around random samples; some samples are in none, some balls are defined by samples outside.
test::Scene scattered(std::mt19937& random, std::size_t samples, std::size_t balls, double radius) {
  test::Scene scene;
  std::vector<Vec3> points, centers;
  std::vector<double> radii;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> defining;
  for (std::size_t s = 0; s < samples; ++s) {
    points.push_back({test::unit(random), test::unit(random), 0.1 * test::unit(random)});
  }
  for (std::size_t i = 0; i < balls; ++i) {
    centers.push_back(points[random() % samples]);
    radii.push_back(radius * test::unit(random));
    if (i % 3 == 0) defining.push_back(static_cast<std::int32_t>(random() % samples));
    offsets.push_back(static_cast<std::int64_t>(defining.size()));
  }
  scene.points.points = std::move(points);
  scene.balls = {std::move(centers), std::move(radii), std::move(offsets), std::move(defining)};
  return scene;
}

CoverState strategy(const CoverState& state) {
  return local_search(lagrangian_bound(ip_solve(reduce(state), *make_lp_solve())));
}

TEST(sample_counts, equal_sums_pair_by_pair) {
  std::mt19937 random(1);
  for (int round = 0; round < 30; ++round) {
    const auto [balls, points] = scattered(random, 1 + random() % 400, 1 + random() % 100, 0.6);
    const SampleTree tree(points.points);
    std::vector<std::int32_t> weights(balls.size()), values(points.points.size());
    for (auto& w : weights) w = static_cast<std::int32_t>(random() % 5) - 1;
    for (auto& v : values) v = static_cast<std::int32_t>(random() % 1000);
    std::vector<std::int64_t> on_samples(values.size()), in_balls(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      for (std::size_t s = 0; s < values.size(); ++s) {
        if (!covers(balls, i, points, s)) continue;
        on_samples[s] += weights[i];
        in_balls[i] += values[s];
      }
    }
    ASSERT_EQ(sums_on_samples(tree, balls, points, weights), on_samples);
    ASSERT_EQ(sums_in_balls(tree, balls, points, values), in_balls);
  }
}

TEST(lazy_bound, is_proven_by_its_certificate_and_never_above_the_optimum) {
  std::mt19937 random(2);
  int reached = 0;
  for (int round = 0; round < 200; ++round) {
    const auto [balls, points] = scattered(random, 10 + random() % 60, 12, 0.5);
    const CoverState state = cover_matrix(balls, points).cover;
    const LazyBound bound = lazy_bound(balls, points, {.columns = 4, .rounds = 6});
    ASSERT_EQ(std::vector<std::int32_t>(state.uncovered.begin(), state.uncovered.end()), bound.uncovered);
    CoverState claimed = state;
    claimed.lower_bound = -1;
    claimed.lower_bound_how = 0;
    prove(claimed, bound.certificate);
    ASSERT_EQ(broken_invariant(claimed), "");
    ASSERT_EQ(verify_certificate(claimed, balls, points), bound.certificate.bound());
    ASSERT_LE(bound.certificate.bound(), test::optimum(state));
    reached += bound.certificate.bound() == test::optimum(state) ? 1 : 0;
  }
  EXPECT_GT(reached, 100);
}

TEST(lazy_bound, is_close_to_the_bound_of_the_whole_matrix) {
  const auto [balls, points] = test::torus(10'000, 0.02, 3);
  const CoverState whole = lagrangian_bound(reduce(cover_matrix(balls, points).cover));
  const LazyBound bound = lazy_bound(balls, points, {.columns = 500});
  EXPECT_GE(bound.certificate.bound(), whole.lower_bound * 97 / 100) << whole.lower_bound;
  EXPECT_LE(bound.certificate.bound(), whole.lower_bound + 2);
}

TEST(large_cover_matrix, has_a_cover_nearly_as_small_and_a_bound_that_geometry_confirms) {
  const auto [balls, points] = test::torus(8000, 0.02, 4);
  const CoverMatrix full = cover_matrix(balls, points);
  CoverState expected;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const CoverMatrix large = cover_matrix(balls, points, {.full_entries = 1000});
    ASSERT_EQ(broken_invariant(large.cover), "");
    if (threads == 1) expected = large.cover;
    ASSERT_TRUE(test::same(large.cover, expected)) << threads;
    ASSERT_EQ(large.cover.left_out, expected.left_out);
  }
  EXPECT_GT(expected.left_out, 0);
  EXPECT_EQ(expected.left_out + static_cast<std::int64_t>(expected.rows()), expected.balls);
  EXPECT_EQ(expected.cols(), full.cover.cols());
  EXPECT_EQ(static_cast<BoundHow>(expected.lower_bound_how), BoundHow::certified);
  const CoverState found = local_search(reduce(expected)), best = local_search(reduce(full.cover));
  EXPECT_TRUE(test::covers(full.cover, found));
  EXPECT_EQ(verify_certificate(found, balls, points), found.lower_bound);
  EXPECT_LE(static_cast<double>(found.chosen.size()), 1.03 * static_cast<double>(best.chosen.size()));
}

TEST(large_cover_matrix, claims_nothing_that_its_rows_alone_seem_to_prove) {
  std::mt19937 random(5);
  int left_out = 0;
  for (int round = 0; round < 200; ++round) {
    const auto [balls, points] = scattered(random, 40, 12, 0.5);
    const CoverState full = cover_matrix(balls, points).cover;
    const CoverState large = cover_matrix(balls, points, {.full_entries = 0}).cover;
    ASSERT_EQ(broken_invariant(large), "");
    const std::int64_t optimum = test::optimum(full);
    left_out += large.left_out > 0 ? 1 : 0;
    for (const CoverState& state : {strategy(large), greedy(large), greedy(reduce(large)), share_bound(large),
                                    ip_solve(large, *make_lp_solve())}) {
      ASSERT_EQ(broken_invariant(state), "");
      ASSERT_LE(state.lower_bound, optimum);
      if (large.left_out > 0) {
        ASSERT_EQ(state.lower_bound, large.lower_bound);
        ASSERT_EQ(state.count(Choice::essential) + state.count(Choice::exact), 0);
      }
      ASSERT_TRUE(state.remaining() > 0 || test::covers(full, state));
    }
  }
  EXPECT_GT(left_out, 100);
}

TEST(large_cover_matrix, treats_uncovered_samples_as_the_whole_matrix_does) {
  std::mt19937 random(6);
  const auto [balls, points] = scattered(random, 300, 12, 0.3);
  const CoverMatrix full = cover_matrix(balls, points),
                    large = cover_matrix(balls, points, {.full_entries = 0});
  ASSERT_FALSE(full.cover.uncovered.empty());
  EXPECT_EQ(large.cover.uncovered, full.cover.uncovered);
  const CoverMatrix with_balls =
      cover_matrix(balls, points, {.uncovered = UncoveredPolicy::ball, .full_entries = 0});
  EXPECT_EQ(broken_invariant(with_balls.cover), "");
  EXPECT_EQ(with_balls.balls.size(), balls.size() + full.cover.uncovered.size());
  EXPECT_TRUE(with_balls.cover.uncovered.empty());
  const CoverState found = strategy(with_balls.cover);
  EXPECT_EQ(verify_cover(select(with_balls.balls, found.chosen), points).uncovered.size(), 0u);
  EXPECT_EQ(verify_certificate(found, with_balls.balls, points), found.lower_bound);
  EXPECT_THROW(cover_matrix(balls, points, {.uncovered = UncoveredPolicy::error, .full_entries = 0}),
               InputError);
}

TEST(large_cover_matrix, accepts_no_balls_no_samples_and_stops_when_cancelled) {
  PointSet points;
  points.points = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(large_cover_matrix({}, points).cover.uncovered.size(), 2u);
  const Balls one{{{0, 0, 0}}, {1.0}, {}, {}};
  EXPECT_EQ(large_cover_matrix(one, {}).cover.cols(), 0u);
  struct Impatient final : Monitor {
    bool cancelled() override { return ++looks > 30; }
    std::atomic<int> looks{0};
  } monitor;
  const auto [balls, many] = test::torus(5000, 0.02, 4);
  EXPECT_THROW(large_cover_matrix(balls, many, {}, monitor), Cancelled);
}

}  // namespace
}  // namespace ballflow::geometry
