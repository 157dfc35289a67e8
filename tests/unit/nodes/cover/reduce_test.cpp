#include "cover/reduce.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "cover/cover_matrix.hpp"
#include "cover/greedy.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

using test::row_sets;
using test::Sets;
using test::state_of;

constexpr ReduceOptions by_hash{.subset_test = SubsetTest::hash};
constexpr ReduceOptions by_bandwidth{.subset_test = SubsetTest::bandwidth};

/// The three rules as they are written down, pass by pass, on sets of original ids.
CoverState reduced_by_definition(const CoverState& state) {
  Sets rows = row_sets(state);
  std::vector<std::int32_t> ids(state.row_ids.begin(), state.row_ids.end());
  std::vector<std::int32_t> columns(state.column_ids.begin(), state.column_ids.end());
  std::vector<std::int32_t> chosen;
  const auto inside = [](const auto& a, const auto& b) {
    return std::includes(b.begin(), b.end(), a.begin(), a.end());
  };
  for (bool changed = true; changed;) {
    changed = false;
    Sets next_rows;
    std::vector<std::int32_t> next_ids;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      bool goes = rows[i].empty();
      for (std::size_t k = 0; k < rows.size(); ++k) {
        goes = goes || (k != i && inside(rows[i], rows[k]) && (rows[i] != rows[k] || k < i));
      }
      changed = changed || goes;
      if (goes) continue;
      next_rows.push_back(rows[i]);
      next_ids.push_back(ids[i]);
    }
    rows = next_rows;
    ids = next_ids;

    const auto column = [&](std::int32_t c) {
      std::vector<std::int32_t> members;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (std::binary_search(rows[i].begin(), rows[i].end(), c))
          members.push_back(static_cast<std::int32_t>(i));
      }
      return members;
    };
    std::vector<std::int32_t> gone;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      for (std::size_t l = 0; l < columns.size(); ++l) {
        const auto outer = column(columns[c]), inner = column(columns[l]);
        if (l == c || !inside(inner, outer) || (inner == outer && c < l)) continue;
        gone.push_back(columns[c]);
        break;
      }
    }
    const auto remove_columns = [&](const std::vector<std::int32_t>& which) {
      const auto listed = [&](std::int32_t c) {
        return std::find(which.begin(), which.end(), c) != which.end();
      };
      for (auto& row : rows) std::erase_if(row, listed);
      std::erase_if(columns, listed);
      changed = changed || !which.empty();
    };
    remove_columns(gone);

    std::set<std::int32_t> essential;
    for (const std::int32_t c : columns) {
      if (const auto members = column(c); members.size() == 1) essential.insert(members[0]);
    }
    std::vector<std::int32_t> covered;
    for (const std::int32_t i : essential) {
      const auto r = static_cast<std::size_t>(i);
      chosen.push_back(ids[r]);
      covered.insert(covered.end(), rows[r].begin(), rows[r].end());
    }
    for (auto i = essential.rbegin(); i != essential.rend(); ++i) {
      rows.erase(rows.begin() + *i);
      ids.erase(ids.begin() + *i);
    }
    remove_columns(covered);
  }
  CoverState result = state_of(rows, static_cast<std::size_t>(state.samples));
  result.row_ids = ids;
  result.chosen = chosen;
  return result;
}

TEST(reduce, is_the_fixed_point_of_the_rules_as_they_are_written_down) {
  std::mt19937 random(5);
  for (int round = 0; round < 3000; ++round) {
    const std::size_t rows = 1 + random() % 12, columns = 1 + random() % 14;
    const CoverState state =
        state_of(test::random_sets(random, rows, columns, 0.05 + 0.6 * test::unit(random)), columns);
    const CoverState expected = reduced_by_definition(state);
    for (const ReduceOptions& options : {ReduceOptions{}, by_hash, by_bandwidth}) {
      const CoverState reduced = reduce(state, options);
      ASSERT_EQ(broken_invariant(reduced), "");
      ASSERT_EQ(row_sets(reduced), row_sets(expected)) << "round " << round;
      ASSERT_EQ(reduced.row_ids, expected.row_ids);
      ASSERT_EQ(reduced.column_ids, expected.column_ids);
      ASSERT_EQ(reduced.chosen, expected.chosen);
    }
  }
}

TEST(reduce, keeps_the_optimum_and_leaves_nothing_to_reduce) {
  std::mt19937 random(6);
  int kept_rows = 0;
  for (int round = 0; round < 4000; ++round) {
    const std::size_t rows = 1 + random() % 12, columns = 1 + random() % 16;
    const CoverState state =
        state_of(test::random_sets(random, rows, columns, 0.1 + 0.4 * test::unit(random)), columns);
    const CoverState reduced = reduce(state);
    const std::int64_t best = test::optimum(state);
    ASSERT_EQ(static_cast<std::int64_t>(reduced.chosen.size()) + test::optimum(reduced), best)
        << "round " << round;
    ASSERT_LE(reduced.lower_bound, best);
    ASSERT_FALSE(test::reducible(reduced));
    ASSERT_TRUE(test::covers(state, greedy(reduced)));
    kept_rows += reduced.rows() > 0 ? 1 : 0;
  }
  EXPECT_GT(kept_rows, 100) << "too few instances resist: the test sees only empty residuals";
}

TEST(reduce, leaves_nothing_to_reduce_of_a_matrix_of_balls) {
  for (const double epsilon : {0.003, 0.02, 0.05}) {
    const auto [balls, points] = test::torus(1200, epsilon, 3);
    const CoverState state = cover_matrix(balls, points).cover;
    const CoverState reduced = reduce(state);
    EXPECT_EQ(broken_invariant(reduced), "");
    EXPECT_FALSE(test::reducible(reduced));
    EXPECT_TRUE(test::covers(state, greedy(reduced)));
    EXPECT_LT(reduced.nnz(), state.nnz() / 2);
    EXPECT_TRUE(test::same(reduced, reduce(state, by_hash)));
    EXPECT_TRUE(test::same(reduced, reduce(state, by_bandwidth)));
    EXPECT_TRUE(test::same(reduced, reduce(reduced)));
  }
}

TEST(reduce, gives_the_same_bytes_for_any_number_of_threads) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  const auto [balls, points] = test::torus(6000, 0.02, 11);
  const CoverState state = cover_matrix(balls, points).cover;
  const auto with_threads = [&](int threads) {
    return tbb::task_arena(threads).execute([&] { return reduce(state); });
  };
  const CoverState one = with_threads(1);
  EXPECT_GT(one.rows(), 0u);
  EXPECT_TRUE(test::same(one, with_threads(2)));
  EXPECT_TRUE(test::same(one, with_threads(4)));
}

TEST(reduce, finds_a_residual_of_equal_size_whatever_the_order_of_rows_and_columns) {
  std::mt19937 random(8);
  for (int round = 0; round < 300; ++round) {
    const std::size_t m = 20, n = 24;
    const Sets rows = test::random_sets(random, m, n, 0.18);
    std::vector<std::int32_t> row_order(m), column_order(n);
    std::iota(row_order.begin(), row_order.end(), 0);
    std::iota(column_order.begin(), column_order.end(), 0);
    std::shuffle(row_order.begin(), row_order.end(), random);
    std::shuffle(column_order.begin(), column_order.end(), random);
    Sets permuted(m);
    for (std::size_t i = 0; i < m; ++i) {
      auto& row = permuted[static_cast<std::size_t>(row_order[i])];
      for (const std::int32_t c : rows[i]) row.push_back(column_order[static_cast<std::size_t>(c)]);
      std::sort(row.begin(), row.end());
    }
    const CoverState a = reduce(state_of(rows, n)), b = reduce(state_of(permuted, n));
    ASSERT_EQ(a.rows(), b.rows());
    ASSERT_EQ(a.cols(), b.cols());
    ASSERT_EQ(a.nnz(), b.nnz());
    ASSERT_EQ(a.chosen.size(), b.chosen.size());
  }
}

TEST(reduce, keeps_the_first_of_equal_rows_and_columns) {
  // A cycle of three rows and columns cannot be reduced; everything in it is there twice.
  const Sets rows{{0, 1, 3, 4}, {0, 1, 3, 4}, {1, 2, 4, 5}, {1, 2, 4, 5}, {0, 2, 3, 5}, {0, 2, 3, 5}};
  const CoverState reduced = reduce(state_of(rows, 6));
  EXPECT_EQ(reduced.row_ids, (Array<std::int32_t>{0, 2, 4}));
  EXPECT_EQ(reduced.column_ids, (Array<std::int32_t>{0, 1, 2}));
  EXPECT_TRUE(reduced.chosen.empty());
}

TEST(reduce, chooses_the_only_ball_of_a_sample) {
  const CoverState reduced = reduce(state_of({{0, 1}, {1, 2}}, 3));
  EXPECT_EQ(reduced.chosen, (Array<std::int32_t>{0, 1}));
  EXPECT_EQ(reduced.count(Choice::essential), 2);
  EXPECT_EQ(reduced.lower_bound, 2);
  EXPECT_EQ(reduced.remaining(), 0u);
}

TEST(reduce, collapses_a_block_of_ones_to_its_first_row) {
  std::vector<std::int32_t> all(2000);
  std::iota(all.begin(), all.end(), 0);
  const CoverState reduced = reduce(state_of(Sets(2000, all), 2000));
  EXPECT_EQ(reduced.chosen, (Array<std::int32_t>{0}));
  EXPECT_EQ(reduced.rows() + reduced.cols(), 0u);
}

TEST(reduce, accepts_an_empty_matrix_and_rows_that_cover_nothing) {
  EXPECT_EQ(broken_invariant(reduce(state_of({}, 0))), "");
  const CoverState reduced = reduce(state_of({{}, {}, {}}, 0));
  EXPECT_EQ(reduced.rows(), 0u);
  EXPECT_TRUE(reduced.chosen.empty());
}

TEST(reduce, adds_to_earlier_choices) {
  CoverState state = state_of({{0}, {1}}, 2);
  state.balls = 4;
  state.chosen = {3, 2};
  state.chosen_how = {2, 2};
  const CoverState reduced = reduce(state);
  EXPECT_EQ(reduced.chosen, (Array<std::int32_t>{3, 2, 0, 1}));
  EXPECT_EQ(reduced.lower_bound, 2) << "the greedy picks prove nothing";
}

TEST(reduce, stops_when_cancelled) {
  class Stop final : public Monitor {
    bool cancelled() override { return true; }
  } stop;
  EXPECT_THROW(reduce(state_of({{0}}, 1), {}, stop), Cancelled);
}

}  // namespace
}  // namespace ballflow::geometry
