#include "cover/components.hpp"

#include <boost/pending/disjoint_sets.hpp>
#include <numeric>

namespace ballflow::geometry {

// The incremental components of Boost.Graph, on the columns alone: a row joins all its columns. The graph
// itself, with millions of edges, is never built.
Components components(const CoverState& state) {
  const std::size_t cols = state.cols();
  std::vector<std::int32_t> rank(cols), parent(cols);
  std::iota(parent.begin(), parent.end(), 0);
  boost::disjoint_sets sets(rank.data(), parent.data());
  for (std::size_t i = 0; i < state.rows(); ++i) {
    const auto row = state.row(i);
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

}  // namespace ballflow::geometry
