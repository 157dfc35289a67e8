#include "cover/greedy_rows.hpp"

#include <algorithm>
#include <queue>
#include <utility>

namespace ballflow::geometry {
namespace {

struct Candidate {
  std::size_t gain;  // columns it covered when it was last counted: it can only have fallen since
  std::int32_t row;
  friend bool operator<(Candidate a, Candidate b) {
    return a.gain != b.gain ? a.gain < b.gain : a.row > b.row;
  }
};

}  // namespace

std::vector<std::int32_t> greedy_rows(const Csr& rows, std::size_t columns, Monitor& monitor) {
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].empty()) all.push_back({rows[i].size(), static_cast<std::int32_t>(i)});
  }
  std::priority_queue<Candidate> heap(std::less<Candidate>(), std::move(all));
  std::vector<std::uint8_t> covered(columns);
  std::size_t left = columns;
  std::vector<std::int32_t> picks;
  Lookout look(monitor);
  // A recounted row whose count did not fall beats every other, whose counts can only be too high.
  while (left > 0) {
    const Candidate top = heap.top();
    heap.pop();
    const auto row = rows[static_cast<std::size_t>(top.row)];
    if (look.due(row.size() + 64)) {  // the heap takes time, too
      monitor.step(1 - static_cast<double>(left) / static_cast<double>(columns));
    }
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

std::vector<std::int32_t> without_redundant(const Csr& rows, std::size_t columns,
                                            const std::vector<std::int32_t>& picks, Monitor& monitor) {
  Lookout look(monitor);
  std::vector<std::int32_t> times(columns);
  for (const std::int32_t i : picks) {
    look(rows[static_cast<std::size_t>(i)].size());
    for (const std::int32_t c : rows[static_cast<std::size_t>(i)]) ++times[static_cast<std::size_t>(c)];
  }
  std::vector<std::int32_t> shortest_first = picks;
  std::sort(shortest_first.begin(), shortest_first.end(), [&](std::int32_t a, std::int32_t b) {
    const std::size_t x = rows[static_cast<std::size_t>(a)].size();
    const std::size_t y = rows[static_cast<std::size_t>(b)].size();
    return x != y ? x < y : a > b;
  });
  std::vector<std::uint8_t> dropped(rows.size());
  for (const std::int32_t i : shortest_first) {
    const auto row = rows[static_cast<std::size_t>(i)];
    look(2 * row.size());
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

}  // namespace ballflow::geometry
