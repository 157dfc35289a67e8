#include "cover/components.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "cover/bandwidth_order.hpp"
#include "cover/near_order.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

using test::Sets;
using test::state_of;

Sets random_rows(std::mt19937& random, std::size_t rows, std::size_t columns) {
  Sets result(rows);
  for (auto& row : result) {
    std::set<std::int32_t> set;
    for (auto k = random() % 4; k > 0; --k) set.insert(static_cast<std::int32_t>(random() % columns));
    row.assign(set.begin(), set.end());
  }
  return result;
}

/// Joins what shares a column or a row until nothing changes.
std::vector<std::int32_t> labels_by_definition(const CoverState& state) {
  std::vector<std::int32_t> label(state.cols());
  for (std::size_t c = 0; c < label.size(); ++c) label[c] = static_cast<std::int32_t>(c);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < state.rows(); ++i) {
      std::int32_t least = static_cast<std::int32_t>(label.size());
      for (const std::int32_t c : state.row(i)) least = std::min(least, label[static_cast<std::size_t>(c)]);
      for (const std::int32_t c : state.row(i)) {
        changed = changed || label[static_cast<std::size_t>(c)] != least;
        label[static_cast<std::size_t>(c)] = least;
      }
    }
  }
  return label;
}

TEST(components, are_those_of_the_definition_numbered_by_their_first_columns) {
  std::mt19937 random(1);
  for (int round = 0; round < 60; ++round) {
    const CoverState state = state_of(random_rows(random, 1 + random() % 30, 30), 30);
    const Components found = components(state);
    const std::vector<std::int32_t> label = labels_by_definition(state);
    std::vector<std::int32_t> firsts;  // the columns that name the components, ascending
    for (std::size_t c = 0; c < label.size(); ++c) {
      if (label[c] == static_cast<std::int32_t>(c)) firsts.push_back(label[c]);
    }
    ASSERT_EQ(found.count(), firsts.size());
    std::vector<std::int32_t> rows(firsts.size(), 0), columns(firsts.size(), 0);
    for (std::size_t c = 0; c < label.size(); ++c) {
      ASSERT_EQ(firsts[static_cast<std::size_t>(found.of_column[c])], label[c]);
      ++columns[static_cast<std::size_t>(found.of_column[c])];
    }
    for (std::size_t i = 0; i < state.rows(); ++i) {
      if (state.row(i).empty()) {
        EXPECT_EQ(found.of_row[i], -1);
        continue;
      }
      ASSERT_EQ(firsts[static_cast<std::size_t>(found.of_row[i])],
                label[static_cast<std::size_t>(state.row(i)[0])]);
      ++rows[static_cast<std::size_t>(found.of_row[i])];
    }
    EXPECT_EQ(found.rows, rows);
    EXPECT_EQ(found.columns, columns);
  }
}

TEST(components, as_matrices_of_their_own_are_the_whole_matrix_together) {
  std::mt19937 random(2);
  const CoverState state = state_of(random_rows(random, 40, 50), 50);
  const Parts parts(state);
  ASSERT_GT(parts.count(), 3u);
  std::size_t entries = 0;
  for (std::size_t k = 0; k < parts.count(); ++k) {
    const Part part = parts.part(k);
    EXPECT_TRUE(std::is_sorted(part.row_ids.begin(), part.row_ids.end()));
    EXPECT_TRUE(std::is_sorted(part.column_ids.begin(), part.column_ids.end()));
    for (std::size_t i = 0; i < part.rows.size(); ++i) {
      const auto whole = state.row(static_cast<std::size_t>(part.row_ids[i]));
      ASSERT_EQ(part.rows.degree(i), whole.size());
      for (std::size_t j = 0; j < whole.size(); ++j, ++entries)
        EXPECT_EQ(part.column_ids[static_cast<std::size_t>(part.rows[i][j])], whole[j]);
    }
    std::int32_t first_whole = -1;
    for (std::size_t i = part.rows.size(); i-- > 0;) {
      if (part.rows.degree(i) == part.column_ids.size()) first_whole = part.row_ids[i];
    }
    EXPECT_EQ(parts.whole_row(k), first_whole);
  }
  EXPECT_EQ(entries, state.nnz());
}

TEST(components, of_an_empty_matrix_are_none) {
  EXPECT_EQ(components(state_of({}, 0)).count(), 0u);
  const Components found = components(state_of({{}, {}}, 3));
  EXPECT_EQ(found.count(), 0u);
  EXPECT_EQ(found.of_row, (std::vector<std::int32_t>{-1, -1}));
}

TEST(components, stop_when_cancelled) {
  struct Impatient final : Monitor {
    bool cancelled() override { return true; }
  } impatient;
  EXPECT_THROW(components(state_of({{0, 1}}, 2), impatient), Cancelled);
}

TEST(bandwidth_order, brings_the_entries_of_a_shuffled_band_near_the_diagonal) {
  std::mt19937 random(3);
  constexpr std::int32_t count = 200;
  std::vector<std::int32_t> row_name(count), column_name(count);
  for (std::int32_t i = 0; i < count; ++i)
    row_name[static_cast<std::size_t>(i)] = column_name[static_cast<std::size_t>(i)] = i;
  std::shuffle(row_name.begin(), row_name.end(), random);
  std::shuffle(column_name.begin(), column_name.end(), random);
  Sets rows(count);
  for (std::int32_t i = 0; i < count; ++i) {
    for (std::int32_t c = std::max(0, i - 2); c <= std::min(count - 1, i + 2); ++c)
      rows[static_cast<std::size_t>(row_name[static_cast<std::size_t>(i)])].push_back(
          column_name[static_cast<std::size_t>(c)]);
  }
  for (auto& row : rows) std::sort(row.begin(), row.end());
  const CoverState state = state_of(rows, count);
  const Csr matrix = rows_of(state);
  const BandwidthOrder order = bandwidth_order(matrix, transpose(matrix, state.cols()));
  std::set<std::int32_t> row_ranks(order.row_rank.begin(), order.row_rank.end());
  std::set<std::int32_t> column_ranks(order.column_rank.begin(), order.column_rank.end());
  EXPECT_EQ(row_ranks.size(), static_cast<std::size_t>(count));
  EXPECT_EQ(*row_ranks.rbegin(), count - 1);
  EXPECT_EQ(column_ranks.size(), static_cast<std::size_t>(count));
  std::int32_t before = 0, after = 0;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (const std::int32_t c : matrix[i]) {
      before = std::max(before, std::abs(static_cast<std::int32_t>(i) - c));
      after = std::max(after, std::abs(order.row_rank[i] - order.column_rank[static_cast<std::size_t>(c)]));
    }
  }
  EXPECT_GT(before, 100);
  EXPECT_LT(after, 12);
}

TEST(near_order, numbers_every_row_and_column_once_even_where_nothing_is_covered) {
  std::mt19937 random(5);
  for (int round = 0; round < 60; ++round) {
    const CoverState state = state_of(random_rows(random, 1 + random() % 400, 300), 300);
    const Csr rows = rows_of(state), columns = transpose(rows, state.cols());
    const NearOrder order = near_order(rows, columns);
    for (const auto* rank : {&order.row_rank, &order.column_rank}) {
      const std::vector<std::int32_t> numbers = inverse(*rank);
      const std::set<std::int32_t> all(numbers.begin(), numbers.end());
      ASSERT_EQ(all.size(), rank->size());
      for (std::size_t i = 0; i < rank->size(); ++i) {
        ASSERT_EQ(numbers[static_cast<std::size_t>((*rank)[i])], static_cast<std::int32_t>(i));
      }
    }
  }
}

TEST(near_order, brings_the_rows_of_a_shuffled_band_together) {
  constexpr std::int32_t n = 5000, width = 7;
  std::vector<std::int32_t> row_name(n), column_name(n);
  std::iota(row_name.begin(), row_name.end(), 0);
  std::iota(column_name.begin(), column_name.end(), 0);
  std::mt19937 random(6);
  std::shuffle(row_name.begin(), row_name.end(), random);
  std::shuffle(column_name.begin(), column_name.end(), random);
  Sets rows(n);
  for (std::int32_t i = 0; i < n; ++i) {
    auto& row = rows[static_cast<std::size_t>(row_name[static_cast<std::size_t>(i)])];
    for (std::int32_t k = i; k < std::min(n, i + width); ++k)
      row.push_back(column_name[static_cast<std::size_t>(k)]);
    std::sort(row.begin(), row.end());
  }
  const CoverState state = state_of(rows, n);
  const Csr matrix = rows_of(state);
  const NearOrder order = near_order(matrix, transpose(matrix, n));
  double extent = 0;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    std::int32_t least = n, most = 0;
    for (const std::int32_t c : matrix[i]) {
      least = std::min(least, order.column_rank[static_cast<std::size_t>(c)]);
      most = std::max(most, order.column_rank[static_cast<std::size_t>(c)]);
    }
    extent += most - least;
  }
  EXPECT_LT(extent / n, 100.0);  // a third of n when shuffled
}

}  // namespace
}  // namespace ballflow::geometry
