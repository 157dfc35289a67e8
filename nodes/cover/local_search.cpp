#include "cover/local_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cover/components.hpp"
#include "cover/greedy_rows.hpp"
#include "cover/region_search.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {
namespace {

constexpr double core_work = 1e9;  // matrix entries that the search in the core visits, times the gap

/// The prices of the columns in the certificate. They are feasible on the whole instance, so on a part of it.
std::vector<std::int64_t> prices_of_columns(const CoverState& state) {
  std::vector<std::int64_t> of_sample(static_cast<std::size_t>(state.samples));
  for (std::size_t i = 0; i < state.certificate_samples.size(); ++i) {
    of_sample[static_cast<std::size_t>(state.certificate_samples[i])] = state.certificate_prices[i];
  }
  std::vector<std::int64_t> prices;
  prices.reserve(state.cols());
  for (const std::int32_t sample : state.column_ids) {
    prices.push_back(of_sample[static_cast<std::size_t>(sample)]);
  }
  return prices;
}

/// Matrix entries that a step visits: those of a row and of a column, on average.
double visited(std::size_t entries, std::size_t rows, std::size_t columns) {
  const auto n = static_cast<double>(entries);
  return std::max(1.0, n / static_cast<double>(std::max<std::size_t>(rows, 1)) +
                           n / static_cast<double>(std::max<std::size_t>(columns, 1)));
}

/// The covers of all components while they are being improved.
class Searches {
 public:
  Searches(const CoverState& state, const LocalSearchOptions& options, Monitor& monitor)
      : state_(state),
        parts_(state, monitor),
        prices_(prices_of_columns(state)),
        seed_(static_cast<std::uint64_t>(options.seed)),
        rows_(parts_.count()),
        searches_(parts_.count()) {
    tbb::parallel_for(std::size_t{0}, parts_.count(), [&](std::size_t k) {
      if (const std::int32_t whole = parts_.whole_row(k); whole >= 0) {
        rows_[k] = {whole};
        return;
      }
      Part part = parts_.part(k, monitor);
      const std::size_t columns = part.columns.size();
      const auto cover =
          without_redundant(part.rows, columns, greedy_rows(part.rows, columns, monitor), monitor);
      for (const std::int32_t i : cover) rows_[k].push_back(part.row_ids[static_cast<std::size_t>(i)]);
      const std::int64_t bound = bound_of(k);
      if (static_cast<std::int64_t>(cover.size()) <= bound) return;
      searches_[k] = std::make_unique<RegionSearch>(std::move(part), cover, bound, seed_ + k, monitor);
    });
  }

  /// Starts again from the best cover of each component that is not proven the least, with all its balls and
  /// other random numbers.
  void restart(std::uint64_t seed, Monitor& monitor) {
    tbb::parallel_for(std::size_t{0}, searches_.size(), [&](std::size_t k) {
      searches_[k].reset();
      if (parts_.whole_row(k) >= 0 || static_cast<std::int64_t>(rows_[k].size()) <= bound_of(k)) return;
      Part part = parts_.part(k, monitor);
      std::vector<std::int32_t> cover;
      for (std::size_t i = 0; i < part.row_ids.size(); ++i) {
        if (std::binary_search(rows_[k].begin(), rows_[k].end(), part.row_ids[i]))
          cover.push_back(static_cast<std::int32_t>(i));
      }
      searches_[k] = std::make_unique<RegionSearch>(std::move(part), cover, bound_of(k), seed + k, monitor);
    });
  }

  bool finished() const {
    return std::none_of(searches_.begin(), searches_.end(),
                        [](const auto& search) { return search != nullptr; });
  }

  /// Rows of the components that are still searched.
  double searched_rows() const {
    double rows = 0;
    for (const auto& search : searches_) rows += search ? static_cast<double>(search->row_ids().size()) : 0;
    return rows;
  }

  /// (balls - bound) / bound of the components that are still searched.
  double searched_gap() const {
    std::int64_t balls = 0, bound = 0;
    for (std::size_t k = 0; k < searches_.size(); ++k) {
      if (!searches_[k]) continue;
      balls += static_cast<std::int64_t>(rows_[k].size());
      bound += bound_of(k);
    }
    return static_cast<double>(balls - bound) / static_cast<double>(std::max<std::int64_t>(bound, 1));
  }

  /// Components share `steps` in proportion to their rows; those that begin with regions make half of theirs.
  void plan(double steps) {
    const double rows = searched_rows();
    for (const auto& search : searches_) {
      if (!search) continue;
      const double all = search->begins_with_regions() ? steps / 2 : steps;
      search->plan(all * static_cast<double>(search->row_ids().size()) / rows);
    }
  }

  /// Steps of all searches.
  double planned() const {
    double sum = 0;
    for (const auto& search : searches_) sum += search ? search->planned() : 0;
    return sum;
  }

  /// Starts again from the best cover of each component, with its core alone. Large covers, and components
  /// about which the certificate says nothing, are searched no more.
  void narrow(double steps_per_row, double work, double max_steps, Monitor& monitor) {
    tbb::parallel_for(std::size_t{0}, searches_.size(), [&](std::size_t k) {
      auto& search = searches_[k];
      if (!search) return;
      if (rows_[k].size() > most_balls_of_core || price_of(k) == 0) {
        search.reset();
        return;
      }
      std::vector<std::int32_t> cover;
      Part part = core(k, parts_.part(k, monitor), search->best(), cover, monitor);
      const double steps =
          std::min({steps_per_row * static_cast<double>(search->row_ids().size()), max_steps,
                    work / visited(part.rows.entries.size(), part.rows.size(), part.columns.size())});
      const std::int64_t forget = mean_weight_of_core * static_cast<std::int64_t>(part.columns.size());
      search = std::make_unique<RegionSearch>(std::move(part), cover, bound_of(k), seed_ + k, monitor,
                                              std::min(forget, WeightingSearch::most_weight));
      search->plan(steps);
    });
  }

  /// Makes the fraction `share` of the steps planned for each search that is not finished.
  void run(double share, Monitor& monitor) {
    tbb::parallel_for(std::size_t{0}, searches_.size(), [&](std::size_t k) {
      auto& search = searches_[k];
      if (!search) return;
      search->run(share, monitor);
      if (search->best().size() < rows_[k].size()) {
        rows_[k].clear();
        for (const std::int32_t i : search->best()) {
          rows_[k].push_back(search->row_ids()[static_cast<std::size_t>(i)]);
        }
        std::sort(rows_[k].begin(), rows_[k].end());
      }
      if (search->proven()) search.reset();
    });
  }

  std::int64_t balls() const {
    auto sum = static_cast<std::int64_t>(state_.chosen.size());
    for (const auto& rows : rows_) sum += static_cast<std::int64_t>(rows.size());
    return sum;
  }

  std::vector<std::int32_t> rows() const {
    std::vector<std::int32_t> all;
    for (const auto& rows : rows_) all.insert(all.end(), rows.begin(), rows.end());
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  static constexpr std::size_t most_balls_of_core = 200;
  static constexpr std::int64_t mean_weight_of_core = 500;

  std::int64_t price_of(std::size_t k) const {
    std::int64_t sum = 0;
    for (const std::int32_t c : parts_.columns(k)) sum += prices_[static_cast<std::size_t>(c)];
    return sum;
  }

  /// What the prices prove about component k.
  std::int64_t bound_of(std::size_t k) const {
    return std::max<std::int64_t>(1, (price_of(k) + price_unit - 1) / price_unit);
  }

  /// The rows of component k that are in its best cover, or whose reduced cost (1 less the prices of their
  /// columns) is at most (balls - bound) / bound. `cover` becomes the best cover in their numbers.
  Part core(std::size_t k, const Part& all, const std::vector<std::int32_t>& best,
            std::vector<std::int32_t>& cover, Monitor& monitor) const {
    const std::int64_t bound = bound_of(k);
    const std::int64_t most = (static_cast<std::int64_t>(best.size()) - bound) * price_unit / bound;
    Part part{{}, all.column_ids, {}, {}};
    std::vector<std::int64_t> offsets{0};
    std::vector<std::int32_t> entries;
    Lookout look(monitor);
    for (std::size_t i = 0; i < all.rows.size(); ++i) {
      look(all.rows.degree(i));
      const bool chosen = cover.size() < best.size() && best[cover.size()] == static_cast<std::int32_t>(i);
      std::int64_t reduced_cost = price_unit;
      for (const std::int32_t c : all.rows[i]) {
        reduced_cost -= prices_[static_cast<std::size_t>(all.column_ids[static_cast<std::size_t>(c)])];
      }
      if (!chosen && reduced_cost > most) continue;
      if (chosen) cover.push_back(static_cast<std::int32_t>(part.row_ids.size()));
      part.row_ids.push_back(all.row_ids[i]);
      entries.insert(entries.end(), all.rows[i].begin(), all.rows[i].end());
      offsets.push_back(static_cast<std::int64_t>(entries.size()));
    }
    part.rows = {std::move(offsets), std::move(entries)};
    part.columns = transpose(part.rows, part.column_ids.size(), monitor);
    return part;
  }

  const CoverState& state_;
  Parts parts_;
  std::vector<std::int64_t> prices_;  // of the columns of the matrix
  std::uint64_t seed_;
  std::vector<std::vector<std::int32_t>> rows_;          // best cover of each component
  std::vector<std::unique_ptr<RegionSearch>> searches_;  // none: finished
};

double number_of_steps(const CoverState& state, double rows, const LocalSearchOptions& options) {
  const double wanted =
      rows * std::min(options.steps_per_ball,
                      options.work_per_ball / visited(state.nnz(), state.rows(), state.cols()));
  return std::min(std::max(wanted, static_cast<double>(options.min_steps)),
                  static_cast<double>(options.max_steps));
}

/// With what low, normal and high effort have in common: searches that go on from each other.
class Effort {
 public:
  Effort(Searches& searches, const CoverState& state, const LocalSearchOptions& options, SearchCurve* curve)
      : searches_(searches), state_(state), options_(options), curve_(curve) {}

  /// Both searches, or `share` of the first.
  void search(double share, Monitor& monitor) {
    search(number_of_steps(state_, searches_.searched_rows(), options_), share, 1, 0, monitor);
  }
  /// Both once more from what was found, for longer.
  void search_longer(Monitor& monitor) {
    constexpr double times = 10, times_least = 1000, times_core = 100, most_work = 6e9;
    LocalSearchOptions longer = options_;
    longer.steps_per_ball *= times;
    longer.work_per_ball *= times;
    longer.max_steps =
        static_cast<std::int64_t>(std::min(times * static_cast<double>(options_.max_steps), 2e9));
    longer.min_steps = static_cast<std::int64_t>(
        std::min({times_least * static_cast<double>(options_.min_steps), 2e9,
                  std::max(static_cast<double>(options_.min_steps),
                           most_work / visited(state_.nnz(), state_.rows(), state_.cols()))}));
    search(number_of_steps(state_, searches_.searched_rows(), longer), 1, times_core, most_work, monitor);
  }

 private:
  /// The second search visits core_work * gap entries, or, with `most_work`, times_core times as many and no
  /// more than that.
  void search(double steps, double share, double times_core, double most_work, Monitor& monitor) {
    if (steps < 1) return;
    PartMonitor first(monitor, 0, share < 1 ? 1 : 0.5), second(monitor, 0.5, 1);
    searches_.plan(steps);
    run(steps, share, first);
    if (share < 1) return;
    const double gap = searches_.searched_gap();
    double work = core_work * times_core * gap;
    if (most_work > 0) work = std::min(work, most_work);
    searches_.narrow(options_.core_steps_per_ball * times_core * gap, work,
                     static_cast<double>(options_.max_steps), monitor);
    run(searches_.planned(), 1, second);
  }

  /// Makes a share of the planned steps, or until the gap is small enough.
  void run(double steps, double share, Monitor& monitor) {
    constexpr int rounds = 64;  // between two looks at the gap
    const int last = static_cast<int>(share * rounds);
    for (int round = 0; round < last; ++round) {
      const std::int64_t balls = searches_.balls(), bound = state_.lower_bound;
      note(balls);
      if (searches_.finished() ||
          static_cast<double>(balls - bound) <= options_.target_gap * static_cast<double>(bound)) {
        return;
      }
      monitor.step(static_cast<double>(round) / last);
      monitor.note(std::to_string(balls) + " balls" +
                   (bound > 0 ? ", at least " + std::to_string(bound) + " needed" : ""));
      searches_.run(1.0 / rounds, monitor);
      made_ += steps / rounds;
    }
    note(searches_.balls());
  }
  void note(std::int64_t balls) {
    if (curve_ == nullptr || (!curve_->balls.empty() && curve_->balls.back() == balls)) return;
    curve_->steps.push_back(made_);
    curve_->balls.push_back(balls);
  }

  Searches& searches_;
  const CoverState& state_;
  const LocalSearchOptions& options_;
  SearchCurve* curve_;
  double made_ = 0;  // steps
};

}  // namespace

CoverState local_search(const CoverState& state, const LocalSearchOptions& options, Monitor& monitor,
                        SearchCurve* curve) {
  monitor.step(0);
  Searches searches(state, options, monitor);
  Effort effort(searches, state, options, curve);
  const bool more = options.effort == SearchEffort::high;
  PartMonitor first(monitor, 0, more ? 0.1 : 1), second(monitor, 0.1, 1);
  effort.search(options.effort == SearchEffort::low ? 0.25 : 1, first);
  if (more) {
    searches.restart(static_cast<std::uint64_t>(options.seed) + (std::uint64_t{1} << 40), second);
    effort.search_longer(second);
  }
  CoverState next = choose(state, searches.rows(), Choice::searched, monitor);
  raise_lower_bound(next);
  monitor.step(1);
  return next;
}

}  // namespace ballflow::geometry
