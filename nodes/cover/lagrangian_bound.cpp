#include "cover/lagrangian_bound.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "cover/certificate.hpp"
#include "cover/greedy_rows.hpp"

namespace ballflow::geometry {
namespace {

using Reals = std::vector<float>;
using Units = std::vector<std::int64_t>;  // of 1 / price_unit

/// Sums of values of the columns over every row. Four sums side by side and the rest in the first, always in
/// the same order: the additions of one sum wait for each other, and the result must not depend on how many
/// the machine does at once. Rows of like length follow each other, near where they were, and every rest has
/// three entries, so that a loop ends where the one before it did: nobody can foresee the ends of others.
/// Columns have 16 bits where that is enough: the entries are read from the memory again and again. Blocks of
/// rows are summed in parallel, each row by one thread.
template <class Number>
class RowSums {
 public:
  RowSums(const Csr& rows, std::size_t columns, Lookout& look) {
    std::vector<std::int32_t> order(rows.size());
    std::iota(order.begin(), order.end(), 0);
    const auto fours = [&rows](std::int32_t i) { return rows.degree(static_cast<std::size_t>(i)) / 4; };
    for (std::size_t first = 0; first < order.size(); first += window) {
      const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
      const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(first + window, order.size()));
      std::stable_sort(begin, end, [&](std::int32_t x, std::int32_t y) { return fours(x) < fours(y); });
    }
    blocks_.push_back({0, 0});
    for (const std::int32_t i : order) {
      const auto row = rows[static_cast<std::size_t>(i)];
      look(row.size());
      if (entries_.size() - blocks_.back().entry >= entries_of_block) {
        blocks_.push_back({rows_.size(), entries_.size()});
      }
      for (const std::int32_t c : row) {
        entries_.push_back(static_cast<Number>(c));
      }
      entries_.resize(entries_.size() + (3 - row.size() % 4), static_cast<Number>(columns));
      rows_.push_back({i, static_cast<std::int32_t>(fours(i))});
    }
    blocks_.push_back({rows_.size(), entries_.size()});
  }

  /// `values` has one element more than there are columns, a zero.
  void operator()(const Reals& values, Reals& sums, Monitor& monitor) const {
    tbb::parallel_for(std::size_t{1}, blocks_.size(), [&](std::size_t b) {
      if (monitor.cancelled()) throw Cancelled();
      sum_block(blocks_[b - 1], blocks_[b], values, sums);
    });
  }

 private:
  static constexpr std::size_t window = 512;  // rows that are sorted by their lengths
  static constexpr std::size_t entries_of_block = std::size_t{1} << 15;  // a few microseconds of work

  struct Row {
    std::int32_t number, fours;
  };
  struct Place {
    std::size_t row, entry;
  };

  void sum_block(Place begin, Place end, const Reals& values, Reals& sums) const {
    const Number* at = entries_.data() + begin.entry;
    const float* const u = values.data();
    for (std::size_t k = begin.row; k < end.row; ++k) {
      float a = 0, b = 0, c = 0, d = 0;
      for (std::int32_t four = 0; four < rows_[k].fours; ++four, at += 4) {
        a += u[at[0]];
        b += u[at[1]];
        c += u[at[2]];
        d += u[at[3]];
      }
      a += u[at[0]];
      a += u[at[1]];
      a += u[at[2]];
      at += 3;
      sums[static_cast<std::size_t>(rows_[k].number)] = (a + b) + (c + d);
    }
  }

  std::vector<Row> rows_;
  std::vector<Number> entries_;  // one row after another: fours, then three of the rest
  std::vector<Place> blocks_;    // where each begins, and the end of the last
};

double sum(std::span<const float> values) {
  double result = 0;
  for (const float value : values) result += static_cast<double>(value);
  return result;
}

/// Takes what loads have above 1 from `bound`; returns the rows whose load is above 1 and was not, or the
/// reverse, and notes that in `loaded`.
std::span<const std::int32_t> take_excess(const Reals& loads, double& bound,
                                          std::vector<std::uint8_t>& loaded,
                                          std::vector<std::int32_t>& changed) {
  double rest = bound;
  std::size_t count = 0;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const std::uint8_t over = loads[i] > 1 ? 1 : 0;
    rest -= static_cast<double>(std::max(loads[i], 1.0F)) - 1;
    changed[count] = static_cast<std::int32_t>(i);
    count += over != loaded[i] ? 1 : 0;
    loaded[i] = over;
  }
  bound = rest;
  return {changed.data(), count};
}

/// The share of each sample in the longest row that contains it: the prices of Theorem 3.8.
Reals shares(const Part& part, Lookout& look) {
  Reals u(part.columns.size());
  for (std::size_t c = 0; c < u.size(); ++c) {
    look(part.columns.degree(c));
    std::size_t longest = 1;
    for (const std::int32_t i : part.columns[c]) {
      longest = std::max(longest, part.rows.degree(static_cast<std::size_t>(i)));
    }
    u[c] = 1.0F / static_cast<float>(longest);
  }
  return u;
}

/// The multipliers of the best bound L(u) that was met. `Number` holds the number of columns. `fractions` of
/// the rows, or null when nobody asks for them.
template <class Number>
Reals climb(const Part& part, const LagrangianBoundOptions& options, std::span<const float> start,
            Reals* fractions, Monitor& monitor) {
  constexpr double second_start = 0.1;  // of the first step
  constexpr float newest = 0.02F;       // what the last iteration counts among the fractions
  const std::size_t rows = part.rows.size(), columns = part.columns.size();
  Lookout look(monitor);
  Reals u = start.empty() ? shares(part, look) : Reals(start.begin(), start.end());
  u.push_back(0);
  const RowSums<Number> row_sums(part.rows, columns, look);
  Reals best = u, direction(columns), loads(rows);
  // 1 less the rows of each column whose load is more than 1: these change little. Whole numbers, so the
  // order in which they are added does not matter.
  Reals slope(columns, 1.0F);
  std::vector<std::uint8_t> loaded(rows);
  std::vector<std::int32_t> changed(rows + 1);
  const auto upper = static_cast<double>(greedy_rows(part.rows, columns, monitor).size());
  const auto momentum = static_cast<float>(options.momentum);
  constexpr float least_slope[] = {-std::numeric_limits<float>::infinity(), 0.0F};
  double best_bound = 0, factor = options.first_step;
  std::int64_t waited = 0, since_best = 0;
  bool climbed = false;  // above the start
  bool return_to_best = options.return_to_best;
  const auto begin_at_best = [&] {
    since_best = 0;
    u = best;
    std::fill(direction.begin(), direction.end(), 0.0F);
  };
  for (std::int64_t t = 0; t < options.iterations; ++t) {
    if (monitor.cancelled()) throw Cancelled();
    double bound = sum({u.data(), columns});
    row_sums(u, loads, monitor);
    for (const std::int32_t row : take_excess(loads, bound, loaded, changed)) {
      const auto i = static_cast<std::size_t>(row);
      look(part.rows.degree(i));
      const float by = loaded[i] != 0 ? -1.0F : 1.0F;
      for (const std::int32_t c : part.rows[i]) slope[static_cast<std::size_t>(c)] += by;
    }
    if (fractions != nullptr) {
      for (std::size_t i = 0; i < rows; ++i) {
        (*fractions)[i] += newest * (static_cast<float>(loaded[i]) - (*fractions)[i]);
      }
    }
    if (bound > best_bound * (1 + 1e-7)) {
      best_bound = bound;
      climbed = t > 0;
      best = u;
      waited = since_best = 0;
    } else {
      ++since_best;
      if (++waited >= options.patience) {
        factor *= options.shrink;
        waited = 0;
        if (factor < 1e-4) {
          // The first step overloads all rows at once; where columns have hundreds of them the steps back are
          // so much shorter that they end before the multipliers are where they began.
          if (climbed || return_to_best) break;
          return_to_best = true;
          factor = second_start * options.first_step;
          begin_at_best();
          continue;
        }
      }
    }
    if (return_to_best && since_best >= 2 * options.patience) {
      begin_at_best();
      continue;
    }
    if (best_bound > upper - 1 + 1e-3) break;  // nothing is left to prove
    double norm = 0;
    for (std::size_t c = 0; c < columns; ++c) {
      // A multiplier of 0 cannot fall. Looked up, as there is no telling which ones are 0.
      const float s = std::max(slope[c], least_slope[u[c] <= 0 ? 1 : 0]);
      direction[c] = t == 0 ? s : momentum * direction[c] + (1 - momentum) * s;
      norm += static_cast<double>(direction[c]) * static_cast<double>(direction[c]);
    }
    if (norm == 0) break;
    const auto step = static_cast<float>(factor * (upper - best_bound) / norm);
    for (std::size_t c = 0; c < columns; ++c) {
      u[c] = std::min(std::max(u[c] + step * direction[c], 0.0F), 1.0F);
    }
  }
  best.pop_back();
  return best;
}

/// Makes the prices feasible, and as high as the balls of each sample allow.
void repair(const Part& part, Units& prices, Monitor& monitor) {
  Lookout look(monitor);
  Units loads(part.rows.size());
  for (std::size_t i = 0; i < part.rows.size(); ++i) {
    look(part.rows.degree(i));
    for (const std::int32_t c : part.rows[i]) loads[i] += prices[static_cast<std::size_t>(c)];
  }
  const auto change = [&](std::int32_t c, std::int64_t by) {
    look(part.columns.degree(static_cast<std::size_t>(c)));
    prices[static_cast<std::size_t>(c)] += by;
    for (const std::int32_t i : part.columns[static_cast<std::size_t>(c)]) {
      loads[static_cast<std::size_t>(i)] += by;
    }
  };
  // Taking a row's excess from its samples costs the sum no more than the row takes from L.
  for (std::size_t i = 0; i < part.rows.size(); ++i) {
    look(part.rows.degree(i));
    for (const std::int32_t c : part.rows[i]) {
      if (loads[i] <= price_unit) break;
      const std::int64_t price = prices[static_cast<std::size_t>(c)];
      if (price > 0) change(c, -std::min(price, loads[i] - price_unit));
    }
  }
  for (std::size_t c = 0; c < part.columns.size(); ++c) {
    look(part.columns.degree(c));
    std::int64_t room = price_unit;
    for (const std::int32_t i : part.columns[c]) {
      room = std::min(room, price_unit - loads[static_cast<std::size_t>(i)]);
    }
    if (room > 0) change(static_cast<std::int32_t>(c), room);
  }
}

}  // namespace

Relaxation relax(const Part& part, const LagrangianBoundOptions& options, std::span<const float> start,
                 Monitor& monitor) {
  Relaxation result{{}, Reals(part.rows.size())};
  result.prices = part.columns.size() <= std::numeric_limits<std::uint16_t>::max()
                      ? climb<std::uint16_t>(part, options, start, &result.fractions, monitor)
                      : climb<std::int32_t>(part, options, start, &result.fractions, monitor);
  return result;
}

std::vector<std::int32_t> feasible_prices(const Part& part, std::span<const float> multipliers,
                                          Monitor& monitor) {
  Units prices(multipliers.size());
  for (std::size_t c = 0; c < multipliers.size(); ++c) {
    prices[c] = static_cast<std::int64_t>(std::min(multipliers[c], 1.0F) * static_cast<float>(price_unit));
  }
  repair(part, prices, monitor);
  return {prices.begin(), prices.end()};
}

std::vector<std::int32_t> lagrangian_prices(const Part& part, const LagrangianBoundOptions& options,
                                            Monitor& monitor) {
  const bool few = part.columns.size() <= std::numeric_limits<std::uint16_t>::max();
  return feasible_prices(part,
                         few ? climb<std::uint16_t>(part, options, {}, nullptr, monitor)
                             : climb<std::int32_t>(part, options, {}, nullptr, monitor),
                         monitor);
}

CoverState lagrangian_bound(const CoverState& state, const LagrangianBoundOptions& options,
                            Monitor& monitor) {
  monitor.step(0);
  if (state.left_out > 0) return state;  // the rows say nothing about the others
  const Parts parts(state, monitor);
  std::vector<std::vector<std::int32_t>> prices(parts.count());
  std::atomic<std::size_t> entries_done{0};
  tbb::parallel_for(std::size_t{0}, parts.count(), [&](std::size_t k) {
    if (parts.whole_row(k) >= 0) {
      prices[k].resize(parts.columns(k).size());
      prices[k].front() = price_unit;
      return;
    }
    const Part part = parts.part(k, monitor);
    prices[k] = lagrangian_prices(part, options, monitor);
    entries_done += part.rows.entries.size();
    monitor.step(static_cast<double>(entries_done) / static_cast<double>(state.nnz()));
  });
  std::vector<std::int32_t> price(state.cols());
  for (std::size_t k = 0; k < parts.count(); ++k) {
    for (std::size_t c = 0; c < prices[k].size(); ++c) {
      price[static_cast<std::size_t>(parts.columns(k)[c])] = prices[k][c];
    }
  }
  CoverState next = state;
  prove(next, priced_groups(state, price, monitor));
  monitor.step(1);
  return next;
}

}  // namespace ballflow::geometry
