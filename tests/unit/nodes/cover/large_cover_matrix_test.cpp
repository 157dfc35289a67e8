#include "cover/large_cover_matrix.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "cover/greedy.hpp"
#include "cover/ip_solve.hpp"
#include "cover/lagrangian_bound.hpp"
#include "cover/local_search.hpp"
#include "cover/matrix_blocks.hpp"
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

/// The rows of each column.
std::vector<std::set<std::int32_t>> columns_of(const CoverState& state) {
  std::vector<std::set<std::int32_t>> columns(state.cols());
  for (std::size_t i = 0; i < state.rows(); ++i) {
    for (const std::int32_t c : state.row(i)) {
      columns[static_cast<std::size_t>(c)].insert(static_cast<std::int32_t>(i));
    }
  }
  return columns;
}

/// Whether every column contains one of `kept`, as far as rows of `among` go.
bool enough(std::vector<std::set<std::int32_t>> columns, const std::vector<std::int32_t>& kept,
            const std::set<std::int32_t>& among) {
  for (auto& column : columns) std::erase_if(column, [&](std::int32_t i) { return among.count(i) == 0; });
  return std::all_of(columns.begin(), columns.end(), [&](const auto& column) {
    return std::any_of(kept.begin(), kept.end(), [&](std::int32_t k) {
      const auto& inner = columns[static_cast<std::size_t>(k)];
      return !inner.empty() && std::includes(column.begin(), column.end(), inner.begin(), inner.end());
    });
  });
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

TEST(matrix_blocks, leave_what_reduces_to_the_same_as_the_whole_matrix) {
  std::mt19937 random(7);
  std::size_t gone = 0;
  for (int round = 0; round < 100; ++round) {
    const auto [balls, points] = scattered(random, 60 + random() % 200, 1 + random() % 80, 0.4);
    const CoverState whole = cover_matrix(balls, points).cover;
    const CoverState some = matrix_of_maximal_rows(balls, points, whole.column_ids, 1 + random() % 20);
    ASSERT_EQ(broken_invariant(some), "");
    gone += whole.rows() - some.rows();
    const CoverState expected = reduce(whole), found = reduce(some);
    ASSERT_EQ(found.row_ids, expected.row_ids);
    ASSERT_EQ(found.column_ids, expected.column_ids);
    ASSERT_EQ(found.row_offsets, expected.row_offsets);
    ASSERT_EQ(found.columns, expected.columns);
    ASSERT_EQ(found.chosen, expected.chosen);
    ASSERT_EQ(found.certificate_samples, expected.certificate_samples);
  }
  EXPECT_GT(gone, 1000u);
}

TEST(matrix_blocks, keep_samples_that_are_enough) {
  std::mt19937 random(8);
  std::size_t gone = 0;
  for (int round = 0; round < 100; ++round) {
    const auto [balls, points] = scattered(random, 60 + random() % 200, 1 + random() % 80, 0.4);
    const CoverState whole = cover_matrix(balls, points).cover;
    const auto columns = columns_of(whole);
    std::set<std::int32_t> all;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(balls.size()); ++i) all.insert(i);
    const auto numbers_of = [&](const std::vector<std::int32_t>& samples) {
      std::vector<std::int32_t> numbers;
      for (const std::int32_t s : samples) {
        const auto at = std::lower_bound(whole.column_ids.begin(), whole.column_ids.end(), s);
        EXPECT_TRUE(at != whole.column_ids.end() && *at == s) << "sample " << s << " is in no ball";
        numbers.push_back(static_cast<std::int32_t>(at - whole.column_ids.begin()));
      }
      return numbers;
    };
    const auto kept = minimal_samples(balls, points, 1 + random() % 40);
    ASSERT_TRUE(std::is_sorted(kept.begin(), kept.end()));
    ASSERT_TRUE(enough(columns, numbers_of(kept), all));
    gone += whole.cols() - kept.size();
    // In one block none that stays contains another.
    const auto least = numbers_of(minimal_samples(balls, points, 1000));
    for (const std::int32_t a : least) {
      for (const std::int32_t b : least) {
        const auto &outer = columns[static_cast<std::size_t>(a)],
                   &inner = columns[static_cast<std::size_t>(b)];
        ASSERT_FALSE(a != b && std::includes(outer.begin(), outer.end(), inner.begin(), inner.end()));
      }
    }
  }
  EXPECT_GT(gone, 1000u);
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
  // Samples that are no column are covered with one that is.
  EXPECT_LT(expected.cols(), full.cover.cols());
  EXPECT_TRUE(enough(columns_of(full.cover), {expected.column_ids.begin(), expected.column_ids.end()},
                     {expected.row_ids.begin(), expected.row_ids.end()}));
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
