#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "cover/cover_matrix.hpp"
#include "cover/greedy.hpp"
#include "cover/ip_solve.hpp"
#include "cover/reduce.hpp"
#include "cover/verify_cover.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

using test::row_sets;
using test::Sets;
using test::state_of;

constexpr std::size_t columns = 14;

/// Up to 12 rows over 14 columns; columns in no row become `uncovered`. Shrinks to few and short rows.
Sets any_sets() {
  const auto masks = *rc::gen::resize(
      12, rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, 1u << columns)));
  Sets rows;
  for (std::size_t i = 0; i < std::min<std::size_t>(masks.size(), 12); ++i) {
    rows.emplace_back();
    for (std::int32_t c = 0; c < static_cast<std::int32_t>(columns); ++c) {
      if ((masks[i] >> c & masks[(i + 1) % masks.size()] >> c & 1) != 0) rows.back().push_back(c);
    }
  }
  return rows;
}

/// Numbers 0 .. count - 1 in any order.
std::vector<std::int32_t> any_order(std::size_t count) {
  std::vector<std::int32_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[*rc::gen::inRange<std::size_t>(0, i)]);
  return order;
}

/// Points on a coarse grid and balls with radii on its scale: many ties, cospherical and equal points.
test::Scene any_scene() {
  const auto coordinate = [] { return 0.25 * *rc::gen::inRange(-8, 9); };
  test::Scene scene;
  std::set<Vec3> points;
  const auto n = *rc::gen::inRange(0, 60), m = *rc::gen::inRange(0, 25);
  for (int j = 0; j < n; ++j) points.insert({coordinate(), coordinate(), coordinate()});
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < m; ++i) {
    centers.push_back({coordinate(), coordinate(), coordinate()});
    radii.push_back(0.25 * *rc::gen::inRange(0, 10));
  }
  scene.points.points = std::vector<Vec3>(points.begin(), points.end());
  scene.balls = {centers, radii, {}, {}};
  return scene;
}

std::int64_t solved_size(const CoverState& state) {
  return static_cast<std::int64_t>(ip_solve(state, *make_lp_solve()).chosen.size());
}

TEST(cover_property, every_cover_of_the_reduced_matrix_completes_a_cover) {
  EXPECT_TRUE(rc::check([] {
    const CoverState state = state_of(any_sets(), columns);
    const CoverState reduced = reduce(state);
    const Sets rest = row_sets(reduced);
    for (std::size_t subset = 0; subset < std::size_t{1} << rest.size(); ++subset) {
      std::set<std::int32_t> covered;
      std::vector<std::int32_t> picks;
      for (std::size_t i = 0; i < rest.size(); ++i) {
        if ((subset >> i & 1) == 0) continue;
        covered.insert(rest[i].begin(), rest[i].end());
        picks.push_back(static_cast<std::int32_t>(i));
      }
      if (covered.size() != reduced.cols()) continue;
      RC_ASSERT(test::covers(state, choose(reduced, picks, Choice::greedy)));
    }
  }));
}

TEST(cover_property, exact_size_does_not_depend_on_the_order_of_rows_and_columns) {
  EXPECT_TRUE(rc::check([] {
    const Sets rows = any_sets();
    const auto row_order = any_order(rows.size()), column_order = any_order(columns);
    Sets permuted(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      auto& row = permuted[static_cast<std::size_t>(row_order[i])];
      for (const std::int32_t c : rows[i]) row.push_back(column_order[static_cast<std::size_t>(c)]);
      std::sort(row.begin(), row.end());
    }
    const CoverState a = state_of(rows, columns), b = state_of(permuted, columns);
    RC_ASSERT(solved_size(a) == test::optimum(a));
    RC_ASSERT(solved_size(b) == solved_size(a));
    RC_ASSERT(solved_size(reduce(b)) == solved_size(a));
  }));
}

TEST(cover_property, balls_that_are_there_twice_change_nothing) {
  EXPECT_TRUE(rc::check([] {
    Sets rows = any_sets();
    const CoverState once = reduce(state_of(rows, columns));
    const std::size_t count = rows.size();
    for (std::size_t i = 0; i < count; ++i) rows.push_back(rows[i]);
    const CoverState twice = reduce(state_of(rows, columns));
    RC_ASSERT(row_sets(twice) == row_sets(once));
    RC_ASSERT(twice.row_ids == once.row_ids);
    RC_ASSERT(twice.chosen == once.chosen);
    RC_ASSERT(greedy(state_of(rows, columns)).chosen ==
              greedy(state_of(Sets(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(count)), columns))
                  .chosen);
  }));
}

TEST(cover_property, all_subset_tests_leave_the_same_matrix) {
  EXPECT_TRUE(rc::check([] {
    const CoverState state = state_of(any_sets(), columns);
    const CoverState reduced = reduce(state);
    RC_ASSERT(test::same(reduced, reduce(state, {.subset_test = SubsetTest::hash})));
    RC_ASSERT(test::same(reduced, reduce(state, {.subset_test = SubsetTest::bandwidth})));
    RC_ASSERT(!test::reducible(reduced));
    RC_ASSERT(broken_invariant(reduced).empty());
  }));
}

TEST(cover_property, permuted_samples_permute_the_matrix) {
  EXPECT_TRUE(rc::check([] {
    const test::Scene scene = any_scene();
    const std::size_t n = scene.points.points.size();
    const auto order = any_order(n);
    std::vector<Vec3> moved(n);
    for (std::size_t j = 0; j < n; ++j) moved[static_cast<std::size_t>(order[j])] = scene.points.points[j];
    const CoverMatrixOptions report{.uncovered = UncoveredPolicy::report};
    Sets expected = row_sets(cover_matrix(scene.balls, scene.points, report).cover);
    for (auto& row : expected) {
      for (std::int32_t& c : row) c = order[static_cast<std::size_t>(c)];
      std::sort(row.begin(), row.end());
    }
    RC_ASSERT(row_sets(cover_matrix(scene.balls, {moved, {}}, report).cover) == expected);
  }));
}

TEST(cover_property, every_strategy_ends_in_a_cover_that_geometry_confirms) {
  EXPECT_TRUE(rc::check([] {
    const test::Scene scene = any_scene();
    const CoverMatrix matrix = cover_matrix(scene.balls, scene.points, {.uncovered = UncoveredPolicy::ball});
    const CoverState all = greedy(matrix.cover, {.mode = GreedyMode::all});
    const CoverState plain = greedy(matrix.cover);
    const CoverState mixed = greedy(ip_solve(reduce(matrix.cover), *make_lp_solve()));
    for (const CoverState& cover : {all, plain, mixed}) {
      RC_ASSERT(broken_invariant(cover).empty());
      RC_ASSERT(cover.remaining() == 0u);
      RC_ASSERT(verify_cover(select(matrix.balls, cover.chosen), scene.points).uncovered.empty());
      RC_ASSERT(cover.lower_bound <= static_cast<std::int64_t>(mixed.chosen.size()));
    }
    RC_ASSERT(mixed.lower_bound ==
              static_cast<std::int64_t>(mixed.chosen.size()));  // at most 60 balls a part
    RC_ASSERT(mixed.chosen.size() <= plain.chosen.size());
    if (!mixed.chosen.empty()) {  // an optimal cover has no ball to spare
      const auto fewer = mixed.chosen.span().first(mixed.chosen.size() - 1);
      RC_ASSERT(
          !verify_cover(select(matrix.balls, fewer), scene.points, {.on_uncovered = OnUncovered::report})
               .uncovered.empty());
    }
  }));
}

}  // namespace
}  // namespace ballflow::geometry
