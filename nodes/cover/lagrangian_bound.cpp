#include "cover/lagrangian_bound.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "cover/certificate.hpp"
#include "cover/greedy_rows.hpp"

namespace ballflow::geometry {
namespace {

using Reals = std::vector<float>;
using Units = std::vector<std::int64_t>;  // of 1 / price_unit

/// The sum of u over a row. Four sums side by side, always in the same order: the additions of one sum wait
/// for each other, and the result must not depend on how many the machine does at once.
float load_of(std::span<const std::int32_t> row, const float* u) {
  float sums[4] = {0, 0, 0, 0};
  std::size_t k = 0;
  for (; k + 4 <= row.size(); k += 4) {
    sums[0] += u[row[k]];
    sums[1] += u[row[k + 1]];
    sums[2] += u[row[k + 2]];
    sums[3] += u[row[k + 3]];
  }
  for (; k < row.size(); ++k) sums[0] += u[row[k]];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// The multipliers of the best bound L(u) that was met.
Reals climb(const Part& part, const LagrangianBoundOptions& options, Monitor& monitor) {
  const std::size_t rows = part.rows.size(), columns = part.columns.size();
  // The share of each sample in the longest row that contains it: the prices of Theorem 3.8.
  Reals u(columns);
  Lookout look(monitor);
  for (std::size_t c = 0; c < columns; ++c) {
    look(part.columns.degree(c));
    std::size_t longest = 1;
    for (const std::int32_t i : part.columns[c]) {
      longest = std::max(longest, part.rows.degree(static_cast<std::size_t>(i)));
    }
    u[c] = 1.0F / static_cast<float>(longest);
  }
  Reals best = u, direction(columns), slope(columns);
  const auto upper = static_cast<double>(greedy_rows(part.rows, columns, monitor).size());
  const auto momentum = static_cast<float>(options.momentum);
  double best_bound = 0, factor = 1;
  std::int64_t waited = 0;
  for (std::int64_t t = 0; t < options.iterations; ++t) {
    if (monitor.cancelled()) throw Cancelled();
    double bound = 0;
    for (std::size_t c = 0; c < columns; ++c) bound += static_cast<double>(u[c]);
    std::fill(slope.begin(), slope.end(), 1.0F);
    for (std::size_t i = 0; i < rows; ++i) {
      const auto row = part.rows[i];
      look(row.size());
      const float load = load_of(row, u.data());
      if (load <= 1) continue;
      bound -= static_cast<double>(load) - 1;
      for (const std::int32_t c : row) slope[static_cast<std::size_t>(c)] -= 1;
    }
    if (bound > best_bound * (1 + 1e-7)) {
      best_bound = bound;
      best = u;
      waited = 0;
    } else if (++waited >= options.patience) {
      factor *= options.shrink;
      waited = 0;
      if (factor < 1e-4) break;
    }
    if (best_bound > upper - 1 + 1e-3) break;  // nothing is left to prove
    double norm = 0;
    for (std::size_t c = 0; c < columns; ++c) {
      // A multiplier of 0 cannot fall.
      const float s = u[c] <= 0 && slope[c] < 0 ? 0.0F : slope[c];
      direction[c] = t == 0 ? s : momentum * direction[c] + (1 - momentum) * s;
      norm += static_cast<double>(direction[c]) * static_cast<double>(direction[c]);
    }
    if (norm == 0) break;
    const auto step = static_cast<float>(factor * (upper - best_bound) / norm);
    for (std::size_t c = 0; c < columns; ++c) u[c] = std::clamp(u[c] + step * direction[c], 0.0F, 1.0F);
  }
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

std::vector<std::int32_t> lagrangian_prices(const Part& part, const LagrangianBoundOptions& options,
                                            Monitor& monitor) {
  const Reals u = climb(part, options, monitor);
  Units prices(u.size());
  for (std::size_t c = 0; c < u.size(); ++c) {
    prices[c] = static_cast<std::int64_t>(std::min(u[c], 1.0F) * static_cast<float>(price_unit));
  }
  repair(part, prices, monitor);
  return {prices.begin(), prices.end()};
}

CoverState lagrangian_bound(const CoverState& state, const LagrangianBoundOptions& options,
                            Monitor& monitor) {
  monitor.step(0);
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
