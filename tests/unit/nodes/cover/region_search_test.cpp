#include "cover/region_search.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>
#include <set>

#include "cover/cover_regions.hpp"
#include "cover/greedy_rows.hpp"
#include "cover/lagrangian_bound.hpp"
#include "cover/local_search.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

using test::state_of;

/// Squares of side 2 `reach` + 1 around random nodes of a grid that is `width` wide: a matrix with the
/// geometry of pruning. Every node is the middle of a square at least once.
CoverState squares(std::mt19937& random, std::int32_t width, std::int32_t reach) {
  test::Sets rows;
  for (std::int32_t node = 0; node < width * width; ++node) {
    const std::int32_t x = node % width, y = node / width;
    const auto by = static_cast<std::int32_t>(random() % static_cast<unsigned>(reach + 1));
    std::vector<std::int32_t> row;
    for (std::int32_t v = std::max(0, y - by); v <= std::min(width - 1, y + by); ++v) {
      for (std::int32_t u = std::max(0, x - by); u <= std::min(width - 1, x + by); ++u)
        row.push_back(v * width + u);
    }
    rows.push_back(row);
  }
  return state_of(rows, static_cast<std::size_t>(width * width));
}

Part whole_part(const CoverState& state) {
  const Parts parts(state);
  EXPECT_EQ(parts.count(), 1u);
  return parts.part(0);
}

std::vector<std::int32_t> start_of(const Part& part) {
  return without_redundant(part.rows, part.columns.size(), greedy_rows(part.rows, part.columns.size()));
}

std::set<std::int32_t> covered_by(const Part& part, const std::vector<std::int32_t>& cover) {
  std::set<std::int32_t> covered;
  for (const std::int32_t i : cover) {
    covered.insert(part.rows[static_cast<std::size_t>(i)].begin(),
                   part.rows[static_cast<std::size_t>(i)].end());
  }
  return covered;
}

TEST(cover_regions, are_small_and_differ_by_seed) {
  std::mt19937 random(1);
  const Part part = whole_part(squares(random, 60, 2));
  const auto cover = start_of(part);
  const auto region = regions_of_cover(part, cover, 30, 5);
  ASSERT_EQ(region.size(), cover.size());
  std::vector<std::size_t> size(cover.size());
  for (const std::int32_t r : region) ++size[static_cast<std::size_t>(r)];
  const auto last = *std::max_element(region.begin(), region.end());
  for (std::int32_t r = 0; r <= last; ++r) {
    EXPECT_GT(size[static_cast<std::size_t>(r)], 5u) << r;
    EXPECT_LE(size[static_cast<std::size_t>(r)], 30u) << r;
  }
  EXPECT_EQ(regions_of_cover(part, cover, 30, 5), region);
  EXPECT_NE(regions_of_cover(part, cover, 30, 6), region);
  EXPECT_EQ(regions_of_cover(part, cover, cover.size(), 5), std::vector<std::int32_t>(cover.size(), 0));
}

TEST(cover_regions, own_each_column_once_and_know_all_rows_that_meet_theirs) {
  std::mt19937 random(2);
  for (int round = 0; round < 20; ++round) {
    const Part part = whole_part(squares(random, 20, 2));
    const auto cover = start_of(part);
    const auto region = regions_of_cover(part, cover, 12, random());
    const RegionColumns columns = columns_of_regions(part, cover, region);
    std::size_t shared = 0;
    for (std::size_t c = 0; c < part.columns.size(); ++c) {
      std::set<std::int32_t> covering;
      for (std::size_t k = 0; k < cover.size(); ++k) {
        const auto row = part.rows[static_cast<std::size_t>(cover[k])];
        if (std::find(row.begin(), row.end(), static_cast<std::int32_t>(c)) != row.end())
          covering.insert(region[k]);
      }
      ASSERT_EQ(columns.of_column[c], *covering.begin());
      shared += covering.size() > 1 ? 1 : 0;
    }
    EXPECT_EQ(columns.shared, shared);
    const std::int32_t last = *std::max_element(region.begin(), region.end());
    for (std::int32_t r = 0; r <= last; ++r) {
      const Part own = region_part(part, columns, r);
      const Part by_rows = region_part({part.row_ids, part.column_ids, part.rows, {}}, columns, r);
      ASSERT_EQ(by_rows.columns.entries, own.columns.entries);
      ASSERT_EQ(own.column_ids.size(),
                static_cast<std::size_t>(std::count(columns.of_column.begin(), columns.of_column.end(), r)));
      std::size_t next = 0;
      for (std::size_t i = 0; i < part.rows.size(); ++i) {
        std::vector<std::int32_t> expected;
        for (const std::int32_t c : part.rows[i]) {
          if (columns.of_column[static_cast<std::size_t>(c)] == r) expected.push_back(c);
        }
        if (expected.empty()) continue;
        ASSERT_LT(next, own.row_ids.size());
        ASSERT_EQ(own.row_ids[next], static_cast<std::int32_t>(i));
        std::vector<std::int32_t> found;
        for (const std::int32_t c : own.rows[next])
          found.push_back(own.column_ids[static_cast<std::size_t>(c)]);
        ASSERT_EQ(found, expected);
        ++next;
      }
      ASSERT_EQ(next, own.row_ids.size());
      ASSERT_EQ(own.columns.entries, transpose(own.rows, own.column_ids.size()).entries);
    }
  }
}

TEST(region_search, has_a_cover_at_any_time_and_never_a_larger_one) {
  std::mt19937 random(3);
  const Part part = whole_part(squares(random, 110, 2));
  const auto start = start_of(part);
  ASSERT_GT(start.size(), RegionSearch::balls_of_region);
  RegionSearch search(part, start, 1, 9, no_monitor());
  search.plan(200'000);
  std::size_t balls = start.size();
  for (int round = 0; round < 64; ++round) {
    search.run(1.0 / 64, no_monitor());
    ASSERT_LE(search.best().size(), balls);
    balls = search.best().size();
    ASSERT_EQ(covered_by(part, search.best()).size(), part.columns.size());
    ASSERT_TRUE(std::is_sorted(search.best().begin(), search.best().end()));
  }
  EXPECT_LT(balls, start.size() * 97 / 100);
}

TEST(region_search, finds_no_more_balls_than_a_search_of_the_whole) {
  std::mt19937 random(4);
  const Part part = whole_part(squares(random, 110, 2));
  const auto start = start_of(part);
  RegionSearch regions(part, start, 1, 9, no_monitor());
  WeightingSearch whole(part, start, 1, 9, no_monitor());
  regions.plan(400'000);
  for (int round = 0; round < 64; ++round) regions.run(1.0 / 64, no_monitor());
  whole.run(400'000, no_monitor());
  EXPECT_LE(regions.best().size(), whole.best().size() * 1005 / 1000) << whole.best().size();
}

TEST(region_search, hands_weights_over_that_are_not_too_large) {
  std::mt19937 random(8);
  const Part part = whole_part(squares(random, 30, 2));
  const auto start = start_of(part);
  std::vector<std::int32_t> heavy(part.columns.size(), 1 << 28);
  heavy[3] = 5;
  const WeightingSearch search(part, start, 1, 9, no_monitor(), WeightingSearch::most_weight, heavy);
  const auto weights = search.weights();
  std::int64_t sum = 0;
  for (const std::int32_t w : weights) sum += w;
  EXPECT_LT(sum, WeightingSearch::most_weight);
  EXPECT_GT(sum, WeightingSearch::most_weight / 4);
  EXPECT_EQ(weights[3], 1);
  EXPECT_EQ(weights[4], weights[5]);
}

TEST(region_search, is_the_same_for_any_number_of_threads) {
  std::mt19937 random(5);
  const CoverState state = lagrangian_bound(squares(random, 120, 2), {.iterations = 50});
  const LocalSearchOptions options{.steps_per_ball = 10, .min_steps = 100'000};
  CoverState expected;
  for (const std::size_t threads : {1, 2, 3, 4, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const CoverState found = local_search(state, options);
    ASSERT_TRUE(test::covers(state, found));
    if (threads == 1) expected = found;
    EXPECT_TRUE(test::same(found, expected)) << threads;
  }
  EXPECT_GT(expected.chosen.size(), RegionSearch::balls_of_region);
}

TEST(region_search, takes_matrices_without_geometry_as_a_whole) {
  std::mt19937 random(6);
  const Part part = whole_part(state_of(test::random_sets(random, 4000, 4000, 0.002), 4000));
  const auto start = start_of(part);
  ASSERT_GT(start.size(), RegionSearch::balls_of_region);
  RegionSearch search(part, start, 1, 9, no_monitor());
  WeightingSearch whole(part, start, 1, 9, no_monitor());
  EXPECT_FALSE(search.begins_with_regions());
  search.plan(10'000);
  search.run(1, no_monitor());
  whole.run(10'001, no_monitor());
  EXPECT_EQ(search.best(), whole.best());
}

TEST(region_search, stops_when_cancelled) {
  struct Impatient final : Monitor {
    bool cancelled() override { return ++looks > 40; }
    std::atomic<int> looks{0};
  } monitor;
  std::mt19937 random(7);
  const Part part = whole_part(squares(random, 110, 2));
  RegionSearch search(part, start_of(part), 1, 9, no_monitor());
  search.plan(1'000'000);
  EXPECT_THROW(search.run(1, monitor), Cancelled);
}

}  // namespace
}  // namespace ballflow::geometry
