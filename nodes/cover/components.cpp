#include "cover/components.hpp"

#include <boost/pending/disjoint_sets.hpp>
#include <numeric>
#include <utility>

namespace ballflow::geometry {

// The incremental components of Boost.Graph, on the columns alone: a row joins all its columns. The graph
// itself, with millions of edges, is never built.
Components components(const CoverState& state, Monitor& monitor) {
  const std::size_t cols = state.cols();
  std::vector<std::int32_t> rank(cols), parent(cols);
  std::iota(parent.begin(), parent.end(), 0);
  boost::disjoint_sets sets(rank.data(), parent.data());
  Lookout look(monitor);
  for (std::size_t i = 0; i < state.rows(); ++i) {
    const auto row = state.row(i);
    look(row.size());
    for (std::size_t k = 1; k < row.size(); ++k) sets.union_set(row[0], row[k]);
  }

  Components result;
  result.of_column.resize(cols);
  std::vector<std::int32_t> number(cols, -1);
  for (std::size_t c = 0; c < cols; ++c) {
    std::int32_t& component = number[static_cast<std::size_t>(sets.find_set(static_cast<std::int32_t>(c)))];
    if (component < 0) {
      component = static_cast<std::int32_t>(result.columns.size());
      result.columns.push_back(0);
    }
    result.of_column[c] = component;
    ++result.columns[static_cast<std::size_t>(component)];
  }
  result.rows.resize(result.columns.size());
  result.of_row.reserve(state.rows());
  for (std::size_t i = 0; i < state.rows(); ++i) {
    const auto row = state.row(i);
    result.of_row.push_back(row.empty() ? -1 : result.of_column[static_cast<std::size_t>(row[0])]);
    if (!row.empty()) ++result.rows[static_cast<std::size_t>(result.of_row.back())];
  }
  return result;
}

namespace {

/// The members of each group, ascending. Negative groups are left out.
Csr members(const std::vector<std::int32_t>& group_of, const std::vector<std::int32_t>& sizes) {
  std::vector<std::int64_t> offsets(sizes.size() + 1);
  for (std::size_t g = 0; g < sizes.size(); ++g) offsets[g + 1] = offsets[g] + sizes[g];
  std::vector<std::int64_t> next(offsets.begin(), offsets.end() - 1);
  std::vector<std::int32_t> entries(static_cast<std::size_t>(offsets.back()));
  for (std::size_t i = 0; i < group_of.size(); ++i) {
    if (group_of[i] < 0) continue;
    const auto g = static_cast<std::size_t>(group_of[i]);
    entries[static_cast<std::size_t>(next[g]++)] = static_cast<std::int32_t>(i);
  }
  return {std::move(offsets), std::move(entries)};
}

}  // namespace

Parts::Parts(const CoverState& state, Monitor& monitor)
    : state_(state),
      components_(components(state, monitor)),
      rows_(members(components_.of_row, components_.rows)),
      columns_(members(components_.of_column, components_.columns)),
      number_(state.cols()) {
  for (std::size_t k = 0; k < count(); ++k) {
    std::int32_t next = 0;
    for (const std::int32_t c : columns(k)) number_[static_cast<std::size_t>(c)] = next++;
  }
}

std::int32_t Parts::whole_row(std::size_t k) const {
  for (const std::int32_t i : rows(k)) {
    if (state_.row(static_cast<std::size_t>(i)).size() == columns(k).size()) return i;
  }
  return -1;
}

Part Parts::part(std::size_t k, Monitor& monitor) const {
  Part part{{rows(k).begin(), rows(k).end()}, {columns(k).begin(), columns(k).end()}, {}, {}};
  std::vector<std::int64_t> offsets{0};
  std::size_t size = 0;
  for (const std::int32_t i : part.row_ids) {
    size += state_.row(static_cast<std::size_t>(i)).size();
    offsets.push_back(static_cast<std::int64_t>(size));
  }
  std::vector<std::int32_t> entries;
  entries.reserve(size);
  Lookout look(monitor);
  for (const std::int32_t i : part.row_ids) {
    look(state_.row(static_cast<std::size_t>(i)).size());
    for (const std::int32_t c : state_.row(static_cast<std::size_t>(i))) {
      entries.push_back(number_[static_cast<std::size_t>(c)]);
    }
  }
  part.rows = {std::move(offsets), std::move(entries)};
  part.columns = transpose(part.rows, part.column_ids.size(), monitor);
  return part;
}

}  // namespace ballflow::geometry
