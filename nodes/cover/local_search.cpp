#include "cover/local_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "cover/components.hpp"
#include "cover/greedy_rows.hpp"
#include "cover/residual.hpp"
#include "cover/weighting_search.hpp"

namespace ballflow::geometry {
namespace {

/// What the prices of the certificate prove about each component: prices that are feasible on the whole
/// instance are so on a part of it.
std::vector<std::int64_t> component_bounds(const CoverState& state, const Parts& parts) {
  std::vector<std::int64_t> price(static_cast<std::size_t>(state.samples));
  for (std::size_t i = 0; i < state.certificate_samples.size(); ++i) {
    price[static_cast<std::size_t>(state.certificate_samples[i])] = state.certificate_prices[i];
  }
  std::vector<std::int64_t> bounds(parts.count());
  for (std::size_t k = 0; k < parts.count(); ++k) {
    std::int64_t sum = 0;
    for (const std::int32_t c : parts.columns(k)) {
      sum += price[static_cast<std::size_t>(state.column_ids[static_cast<std::size_t>(c)])];
    }
    bounds[k] = std::max<std::int64_t>(1, (sum + price_unit - 1) / price_unit);
  }
  return bounds;
}

/// The covers of all components while they are being improved.
class Searches {
 public:
  Searches(const CoverState& state, const LocalSearchOptions& options, Monitor& monitor)
      : state_(state), parts_(state, monitor), rows_(parts_.count()), searches_(parts_.count()) {
    const std::vector<std::int64_t> bounds = component_bounds(state, parts_);
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
      if (static_cast<std::int64_t>(cover.size()) <= bounds[k]) return;
      searches_[k] = std::make_unique<WeightingSearch>(std::move(part), cover, bounds[k],
                                                       static_cast<std::uint64_t>(options.seed) + k, monitor);
    });
  }

  /// Rows of the components that are still searched, and their number.
  std::int64_t searched_rows() const {
    std::int64_t rows = 0;
    for (const auto& search : searches_) {
      if (search) rows += static_cast<std::int64_t>(search->part().row_ids.size());
    }
    return rows;
  }

  /// Goes on with every search that is not finished; rows get `steps_per_row` steps each.
  void run(double steps_per_row, Monitor& monitor) {
    tbb::parallel_for(std::size_t{0}, searches_.size(), [&](std::size_t k) {
      if (!searches_[k]) return;
      WeightingSearch& search = *searches_[k];
      const auto& ids = search.part().row_ids;
      search.run(static_cast<std::int64_t>(steps_per_row * static_cast<double>(ids.size())) + 1, monitor);
      if (search.best().size() < rows_[k].size()) {
        rows_[k].clear();
        for (const std::int32_t i : search.best()) rows_[k].push_back(ids[static_cast<std::size_t>(i)]);
      }
      if (search.proven()) searches_[k].reset();
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
  const CoverState& state_;
  Parts parts_;
  std::vector<std::vector<std::int32_t>> rows_;  // best cover of each component
  std::vector<std::unique_ptr<WeightingSearch>> searches_;
};

double number_of_steps(const CoverState& state, double rows, const LocalSearchOptions& options) {
  const auto entries = static_cast<double>(state.nnz());
  const double visited = entries / static_cast<double>(std::max<std::size_t>(state.rows(), 1)) +
                         entries / static_cast<double>(std::max<std::size_t>(state.cols(), 1));
  const double wanted =
      rows * std::min(options.steps_per_ball, options.work_per_ball / std::max(visited, 1.0));
  return std::min(std::max(wanted, static_cast<double>(options.min_steps)),
                  static_cast<double>(options.max_steps));
}

bool good_enough(std::int64_t balls, std::int64_t bound, double target_gap) {
  return static_cast<double>(balls - bound) <= target_gap * static_cast<double>(bound);
}

}  // namespace

CoverState local_search(const CoverState& state, const LocalSearchOptions& options, Monitor& monitor) {
  monitor.step(0);
  Searches searches(state, options, monitor);
  const auto rows = static_cast<double>(searches.searched_rows());
  const double steps = number_of_steps(state, rows, options);
  constexpr int rounds = 64;  // between two looks at the gap
  for (int round = 0; round < rounds && steps >= 1; ++round) {
    if (searches.searched_rows() == 0 ||
        good_enough(searches.balls(), state.lower_bound, options.target_gap)) {
      break;
    }
    monitor.step(static_cast<double>(round) / rounds);
    searches.run(steps / rows / rounds, monitor);
  }
  CoverState next = choose(state, searches.rows(), Choice::searched, monitor);
  raise_lower_bound(next);
  monitor.step(1);
  return next;
}

}  // namespace ballflow::geometry
