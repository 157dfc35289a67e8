#include "cover/share_bound.hpp"

#include <gtest/gtest.h>

#include "cover/greedy.hpp"
#include "cover/reduce.hpp"
#include "cover/residual.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

using test::Sets;
using test::state_of;

TEST(share_bound, sums_one_over_the_longest_row_of_each_sample) {
  // Shares 1/3 for samples 0 to 2, 1/2 for the other two: 2.
  EXPECT_EQ(share_bound(state_of({{0, 1, 2}, {2, 3}, {3, 4}}, 5)).lower_bound, 2);
  // Shares 1/4 for four samples, 1/2 for one: 1.5.
  EXPECT_EQ(share_bound(state_of({{0, 1, 2, 3}, {3, 4}}, 5)).lower_bound, 2);
}

TEST(share_bound, is_the_formula_of_theorem_3_8_or_better) {
  std::mt19937 random(61);
  int tight = 0;
  for (int round = 0; round < 2000; ++round) {
    const std::size_t rows = 3 + random() % 10, columns = 3 + random() % 16;
    const CoverState original =
        state_of(test::random_sets(random, rows, columns, 0.1 + 0.4 * test::unit(random)), columns);
    const CoverState reduced = reduce(original), bounded = share_bound(reduced);
    // Rows have at most 18 columns, so all shares are multiples of 1 / unit.
    const std::int64_t unit = 16 * 9 * 5 * 7 * 11 * 13 * 17;
    std::int64_t sum = 0;
    const Sets sets = test::row_sets(reduced);
    for (const std::int32_t sample : reduced.column_ids) {
      std::size_t alpha = 0;
      for (const auto& row : sets) {
        if (std::binary_search(row.begin(), row.end(), sample)) alpha = std::max(alpha, row.size());
      }
      sum += unit / static_cast<std::int64_t>(alpha);
    }
    ASSERT_GE(bounded.lower_bound, reduced.count(Choice::essential) + (sum + unit - 1) / unit);
    ASSERT_LE(bounded.lower_bound, test::optimum(original));
    ASSERT_EQ(test::certificate_error(original, bounded), "");
    ASSERT_EQ(broken_invariant(bounded), "");
    tight += bounded.certified_bound() == bounded.lower_bound ? 1 : 0;
  }
  EXPECT_GT(tight, 1800);  // prices are rounded down, which rarely costs a ball
}

TEST(share_bound, rounds_up_component_by_component) {
  const CoverState state = state_of({{0, 1}, {1, 2}, {3, 4}, {4, 5}}, 6);
  EXPECT_EQ(share_bound(state).lower_bound, 4);
}

TEST(share_bound, looks_at_what_is_left_only) {
  const CoverState state = state_of({{0, 1, 2, 3}, {3, 4}, {4, 5}}, 6);
  CoverState rest = choose(state, std::vector<std::int32_t>{0}, Choice::essential);
  EXPECT_EQ(share_bound(rest).lower_bound, 2);
  rest = choose(state, std::vector<std::int32_t>{0}, Choice::greedy);
  EXPECT_EQ(share_bound(rest).lower_bound, 1);
}

TEST(share_bound, accepts_an_empty_matrix) { EXPECT_EQ(share_bound(state_of({}, 0)).lower_bound, 0); }

}  // namespace
}  // namespace ballflow::geometry
