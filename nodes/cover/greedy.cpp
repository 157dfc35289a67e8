#include "cover/greedy.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "cover/components.hpp"
#include "cover/greedy_rows.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {
namespace {

/// The longest row of each component, the first among equals.
std::vector<std::int32_t> longest_rows(const CoverState& state, const Components& parts) {
  std::vector<std::int32_t> best(parts.count(), -1);
  for (std::size_t i = 0; i < state.rows(); ++i) {
    if (parts.of_row[i] < 0) continue;
    std::int32_t& row = best[static_cast<std::size_t>(parts.of_row[i])];
    if (row < 0 || state.row(i).size() > state.row(static_cast<std::size_t>(row)).size()) {
      row = static_cast<std::int32_t>(i);
    }
  }
  return best;
}

/// The sum over the components of ceil(columns / longest row): what the residual needs at least.
std::int64_t component_bound(const CoverState& state, const Components& parts,
                             const std::vector<std::int32_t>& longest) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < parts.count(); ++k) {
    const auto length = static_cast<std::int64_t>(state.row(static_cast<std::size_t>(longest[k])).size());
    sum += (parts.columns[k] + length - 1) / length;
  }
  return sum;
}

}  // namespace

CoverState greedy(const CoverState& state, const GreedyOptions& options, Monitor& monitor) {
  monitor.step(0);
  if (options.mode == GreedyMode::all) {
    std::vector<std::int32_t> every(state.rows());
    std::iota(every.begin(), every.end(), 0);
    CoverState next = choose(state, every, Choice::all, monitor);
    raise_lower_bound(next);
    return next;
  }

  const Components parts = components(state, monitor);
  const std::vector<std::int32_t> longest = longest_rows(state, parts);
  CoverState bounded = state;
  raise_lower_bound(bounded, optimal_choices(state) + component_bound(state, parts, longest),
                    BoundHow::lemma_3_7);
  std::vector<std::int32_t> picks = longest;
  if (options.mode == GreedyMode::until_covered) {
    picks = greedy_rows(rows_of(state), state.cols(), monitor);
    if (options.remove_redundant) picks = without_redundant(rows_of(state), state.cols(), picks, monitor);
  }
  CoverState next = choose(bounded, picks, Choice::greedy, monitor);
  raise_lower_bound(next);
  monitor.step(1);
  return next;
}

}  // namespace ballflow::geometry
