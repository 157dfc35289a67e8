#include "cover/greedy.hpp"

#include <algorithm>
#include <numeric>
#include <queue>
#include <vector>

#include "cover/components.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {
namespace {

struct Candidate {
  std::size_t gain;  // columns it covered when it was last counted: it can only have fallen since
  std::int32_t row;
  friend bool operator<(Candidate a, Candidate b) {
    return a.gain != b.gain ? a.gain < b.gain : a.row > b.row;
  }
};

std::vector<std::int32_t> until_covered(const CoverState& state, Monitor& monitor) {
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < state.rows(); ++i) {
    if (!state.row(i).empty()) all.push_back({state.row(i).size(), static_cast<std::int32_t>(i)});
  }
  std::priority_queue<Candidate> heap(std::less<Candidate>(), std::move(all));
  std::vector<std::uint8_t> covered(state.cols());
  std::size_t left = state.cols();
  std::vector<std::int32_t> picks;
  // A recounted row whose count did not fall beats every other, whose counts can only be too high.
  for (std::size_t looks = 0; left > 0; ++looks) {
    if (looks % 4096 == 0) monitor.step(1 - static_cast<double>(left) / static_cast<double>(state.cols()));
    const Candidate top = heap.top();
    heap.pop();
    const auto row = state.row(static_cast<std::size_t>(top.row));
    const auto gain = static_cast<std::size_t>(std::count_if(
        row.begin(), row.end(), [&](std::int32_t c) { return covered[static_cast<std::size_t>(c)] == 0; }));
    if (gain < top.gain) {
      if (gain > 0) heap.push({gain, top.row});
      continue;
    }
    picks.push_back(top.row);
    left -= gain;
    for (const std::int32_t c : row) covered[static_cast<std::size_t>(c)] = 1;
  }
  return picks;
}

/// `picks` without those whose columns the remaining ones cover, in the same order.
std::vector<std::int32_t> without_redundant(const CoverState& state, const std::vector<std::int32_t>& picks) {
  std::vector<std::int32_t> times(state.cols());
  for (const std::int32_t i : picks) {
    for (const std::int32_t c : state.row(static_cast<std::size_t>(i))) ++times[static_cast<std::size_t>(c)];
  }
  std::vector<std::int32_t> shortest_first = picks;
  std::sort(shortest_first.begin(), shortest_first.end(), [&](std::int32_t a, std::int32_t b) {
    const std::size_t x = state.row(static_cast<std::size_t>(a)).size();
    const std::size_t y = state.row(static_cast<std::size_t>(b)).size();
    return x != y ? x < y : a > b;
  });
  std::vector<std::uint8_t> dropped(state.rows());
  for (const std::int32_t i : shortest_first) {
    const auto row = state.row(static_cast<std::size_t>(i));
    if (!std::all_of(row.begin(), row.end(),
                     [&](std::int32_t c) { return times[static_cast<std::size_t>(c)] > 1; })) {
      continue;
    }
    dropped[static_cast<std::size_t>(i)] = 1;
    for (const std::int32_t c : row) --times[static_cast<std::size_t>(c)];
  }
  std::vector<std::int32_t> kept;
  std::copy_if(picks.begin(), picks.end(), std::back_inserter(kept),
               [&](std::int32_t i) { return dropped[static_cast<std::size_t>(i)] == 0; });
  return kept;
}

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
    CoverState next = choose(state, every, Choice::all);
    raise_lower_bound(next);
    return next;
  }

  const Components parts = components(state);
  const std::vector<std::int32_t> longest = longest_rows(state, parts);
  CoverState bounded = state;
  raise_lower_bound(bounded, optimal_choices(state) + component_bound(state, parts, longest),
                    BoundHow::lemma_3_7);
  std::vector<std::int32_t> picks = longest;
  if (options.mode == GreedyMode::until_covered) {
    picks = until_covered(state, monitor);
    if (options.remove_redundant) picks = without_redundant(state, picks);
  }
  CoverState next = choose(bounded, picks, Choice::greedy);
  raise_lower_bound(next);
  monitor.step(1);
  return next;
}

}  // namespace ballflow::geometry
