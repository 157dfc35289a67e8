#include "cover/lazy_bound.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <string>
#include <utility>

#include "cover/components.hpp"
#include "cover/cover_matrix.hpp"
#include "cover/lagrangian_bound.hpp"
#include "cover/matrix_blocks.hpp"
#include "cover/reduce.hpp"
#include "cover/sample_counts.hpp"

namespace ballflow::geometry {
namespace {

using Ids = std::vector<std::int32_t>;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr std::int32_t whole = 1 << 20;  // of a fractional ball
constexpr std::size_t balls_of_block = 4096;

/// The listed samples and what the climbs have found about them.
class Listed {
 public:
  Listed(const Balls& balls, const PointSet& points, const SampleTree& tree, const LazyBoundOptions& options)
      : balls_(balls), points_(points), tree_(tree), options_(options), price_(points.points.size()) {}

  /// Lists a sample of each of about `options.columns` groups of neighbours, the first that is covered.
  void begin(const std::vector<std::uint8_t>& covered) {
    const std::size_t n = covered.size();
    const auto wanted = static_cast<std::size_t>(std::max<std::int64_t>(options_.columns, 1));
    const std::size_t group = std::max<std::size_t>(1, n / wanted);
    for (std::size_t first = 0; first < n; first += group) {
      for (std::size_t k = first; k < std::min(n, first + group); ++k) {
        if (covered[at(tree_.order()[k])] == 0) continue;
        ids_.push_back(tree_.order()[k]);
        break;
      }
    }
    std::sort(ids_.begin(), ids_.end());
  }

  /// The matrix of the listed samples, reduced.
  CoverState reduced(Monitor& monitor) const {
    PartMonitor first(monitor, 0, 0.7), second(monitor, 0.7, 1);
    return reduce(matrix_of_maximal_rows(balls_, points_, ids_, balls_of_block, first), {}, second);
  }

  /// Climbs from the prices of the round before, which it replaces. Returns how much of each ball the
  /// relaxation takes, in 1 / whole, and notes prices that are feasible when `last`.
  Ids climb(const CoverState& state, bool first, bool last, Monitor& monitor) {
    LagrangianBoundOptions options;
    options.iterations = last ? options_.last_iterations : options_.iterations;
    options.patience = 15;
    options.first_step = first ? 1 : 0.1;
    options.return_to_best = true;
    const Parts parts(state, monitor);
    Ids fraction(balls_.size());
    for (const std::int32_t ball : state.chosen) fraction[at(ball)] = whole;
    feasible_.assign(last ? state.cols() : 0, 0);
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, parts.count(), [&](std::size_t k) {
      const auto columns = parts.columns(k);
      if (const std::int32_t row = parts.whole_row(k); row >= 0) {
        fraction[at(state.row_ids[at(row)])] = whole;
        for (const std::int32_t c : columns) price_[at(sample_of(state, c))] = 0;
        price_[at(sample_of(state, columns.front()))] = 1;
        if (last) feasible_[at(columns.front())] = static_cast<std::int32_t>(price_unit);
        return;
      }
      const Part part = parts.part(k, monitor);
      std::vector<float> start;
      for (const std::int32_t c : columns) start.push_back(price_[at(sample_of(state, c))]);
      if (first) start.clear();
      const Relaxation found = relax(part, options, start, monitor);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        price_[at(sample_of(state, columns[c]))] = found.prices[c];
      }
      for (std::size_t i = 0; i < part.row_ids.size(); ++i) {
        fraction[at(state.row_ids[at(part.row_ids[i])])] =
            static_cast<std::int32_t>(found.fractions[i] * static_cast<float>(whole));
      }
      if (last) {
        const Ids prices = feasible_prices(part, found.prices, monitor);
        for (std::size_t c = 0; c < columns.size(); ++c) feasible_[at(columns[c])] = prices[c];
      }
      done += part.rows.entries.size();
      monitor.step(static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(state.nnz(), 1)));
    });
    return fraction;
  }

  /// Lists the least covered samples, at most one of each group of neighbours: the worst of all groups.
  void extend(const std::vector<std::int64_t>& coverage, const std::vector<std::uint8_t>& covered) {
    const auto most = static_cast<std::size_t>(options_.growth * static_cast<double>(ids_.size())) + 1;
    const auto enough = static_cast<std::int64_t>(options_.least_coverage * whole);
    const std::size_t n = coverage.size(), group = std::max<std::size_t>(1, n / (2 * ids_.size() + 1));
    std::vector<std::pair<std::int64_t, std::int32_t>> worst;
    for (std::size_t first = 0; first < n; first += group) {
      std::pair<std::int64_t, std::int32_t> least{enough, -1};
      for (std::size_t k = first; k < std::min(n, first + group); ++k) {
        const std::int32_t s = tree_.order()[k];
        if (covered[at(s)] != 0) least = std::min(least, {coverage[at(s)], s});
      }
      if (least.second >= 0) worst.push_back(least);
    }
    if (worst.size() > most) {
      std::nth_element(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(most), worst.end());
      worst.resize(most);
    }
    for (const auto& [value, s] : worst) ids_.push_back(s);
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  }

  std::size_t size() const { return ids_.size(); }

  /// What the reduction and the feasible prices prove, about samples of the instance.
  PricedGroups certificate(CoverState state, Monitor& monitor) const {
    prove(state, priced_groups(state, feasible_, monitor));
    PricedGroups groups;
    for (std::size_t k = 0; k < state.certificate_samples.size(); ++k) {
      if (k > 0 && state.certificate_groups[k] != state.certificate_groups[k - 1]) groups.close();
      groups.add(state.certificate_samples[k], state.certificate_prices[k]);
    }
    groups.close();
    return groups;
  }

 private:
  static std::int32_t sample_of(const CoverState& state, std::int32_t column) {
    return state.column_ids[at(column)];
  }

  const Balls& balls_;
  const PointSet& points_;
  const SampleTree& tree_;
  const LazyBoundOptions& options_;
  Ids ids_;                   // ascending
  std::vector<float> price_;  // of every sample of the instance: the last that it had
  Ids feasible_;              // of the columns of the last matrix
};

}  // namespace

LazyBound lazy_bound(const Balls& balls, const PointSet& points, const LazyBoundOptions& options,
                     Monitor& monitor) {
  require_coverable(balls, points);
  const SampleTree tree(points.points);
  LazyBound result;
  PartMonitor start(monitor, 0, 0.1);
  const auto times = sums_on_samples(tree, balls, points, Ids(balls.size(), 1), start);
  std::vector<std::uint8_t> covered(times.size());
  for (std::size_t s = 0; s < times.size(); ++s) {
    covered[s] = times[s] > 0 ? 1 : 0;
    if (times[s] == 0) result.uncovered.push_back(static_cast<std::int32_t>(s));
  }
  Listed listed(balls, points, tree, options);
  listed.begin(covered);
  if (listed.size() == 0) return result;
  for (int round = 0;; ++round) {
    const auto progress = [&](double within) { return 0.1 + 0.9 * (round + within) / options.rounds; };
    PartMonitor making(monitor, progress(0), progress(0.5)), climbing(monitor, progress(0.5), progress(0.9)),
        looking(monitor, progress(0.9), progress(1));
    const bool last = round + 1 >= options.rounds;
    CoverState state = listed.reduced(making);
    const Ids fraction = listed.climb(state, round == 0, last, climbing);
    if (last) {
      result.certificate = listed.certificate(std::move(state), monitor);
      return result;
    }
    monitor.note("round " + std::to_string(round + 1) + " of " + std::to_string(options.rounds) + ", " +
                 std::to_string(listed.size()) + " samples listed");
    listed.extend(sums_on_samples(tree, balls, points, fraction, looking), covered);
  }
}

}  // namespace ballflow::geometry
