#include "cover/ip_solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cover/certificate.hpp"
#include "cover/components.hpp"

namespace ballflow::geometry {
namespace {

using Ids = std::vector<std::int32_t>;

/// The first column of `columns` that contains none of `rows`, which ascend.
std::optional<std::size_t> first_missed(const Csr& columns, const Ids& rows) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const auto column = columns[c];
    const bool met = std::any_of(column.begin(), column.end(), [&](std::int32_t i) {
      return std::binary_search(rows.begin(), rows.end(), i);
    });
    if (!met) return c;
  }
  return std::nullopt;
}

/// Prices of the columns in 1 / price_unit from dual values that are feasible up to rounding, or from none.
/// What they prove is decided in integers: no row costs more than 1.
std::vector<std::int64_t> whole_prices(const IpProblem& problem, const std::vector<double>& duals) {
  std::vector<std::int64_t> prices(problem.columns.size());
  if (duals.size() != prices.size()) return prices;
  std::vector<double> load(problem.rows);
  const auto dual = [&](std::size_t c) {
    return std::isfinite(duals[c]) ? std::clamp(duals[c], 0.0, 1.0) : 0.0;
  };
  for (std::size_t c = 0; c < prices.size(); ++c) {
    for (const std::int32_t i : problem.columns[c]) load[static_cast<std::size_t>(i)] += dual(c);
  }
  std::vector<std::int64_t> cost(problem.rows);
  for (std::size_t c = 0; c < prices.size(); ++c) {
    double most = 1;
    for (const std::int32_t i : problem.columns[c]) most = std::max(most, load[static_cast<std::size_t>(i)]);
    prices[c] = static_cast<std::int64_t>(dual(c) / most * static_cast<double>(price_unit));
    for (const std::int32_t i : problem.columns[c]) cost[static_cast<std::size_t>(i)] += prices[c];
  }
  // Rounding may leave a row a few units above 1: its columns give them back, the first ones first.
  for (std::size_t c = 0; c < prices.size(); ++c) {
    std::int64_t excess = 0;
    for (const std::int32_t i : problem.columns[c]) {
      excess = std::max(excess, cost[static_cast<std::size_t>(i)] - price_unit);
    }
    excess = std::min(excess, prices[c]);
    if (excess <= 0) continue;
    prices[c] -= excess;
    for (const std::int32_t i : problem.columns[c]) cost[static_cast<std::size_t>(i)] -= excess;
  }
  return prices;
}

/// A solver is never taken at its word: throws where its answer contradicts the matrix, itself, or what the
/// prices prove.
void require_sound(const IpProblem& problem, const IpAnswer& answer, std::int64_t proven,
                   std::size_t component) {
  std::string wrong;
  const auto size = static_cast<std::int64_t>(answer.rows.size());
  if (!answer.rows.empty()) {
    if (const auto missed = first_missed(problem.columns, answer.rows)) {
      wrong = "leaves column " + std::to_string(*missed) + " of " + std::to_string(problem.columns.size()) +
              " uncovered";
    } else if (size < std::max(proven, answer.lower_bound) || size >= problem.upper_bound) {
      wrong = "has " + std::to_string(size) + " balls, where at least " +
              std::to_string(std::max(proven, answer.lower_bound)) + " and fewer than " +
              std::to_string(problem.upper_bound) + " were possible";
    }
  } else if (answer.finished && problem.upper_bound > static_cast<std::int64_t>(problem.rows)) {
    wrong = "is empty, although all balls together are a cover";
  }
  if (wrong.empty() && answer.lower_bound > problem.upper_bound) {
    wrong = "claims a lower bound of " + std::to_string(answer.lower_bound) + " above the upper bound of " +
            std::to_string(problem.upper_bound);
  }
  if (wrong.empty()) return;
  throw InputError("the solver's answer for component " + std::to_string(component) + " " + wrong,
                   "this is a bug of the solver: take the other solver, or set max_balls below " +
                       std::to_string(problem.rows) + ", and report it");
}

/// Which rows of the matrix a known cover has chosen, and how.
class Known {
 public:
  Known(const CoverState& state, const CoverState* cover) : present_(cover != nullptr) {
    if (!present_) return;
    if (cover->balls != state.balls || cover->samples != state.samples || cover->remaining() != 0) {
      throw InputError("the known cover is of " + std::to_string(cover->balls) + " balls and " +
                           std::to_string(cover->samples) + " samples with " +
                           std::to_string(cover->remaining()) + " not yet covered, the matrix of " +
                           std::to_string(state.balls) + " and " + std::to_string(state.samples),
                       "connect a whole cover of the same instance to known");
    }
    how_.assign(static_cast<std::size_t>(state.balls), none);
    for (std::size_t k = 0; k < cover->chosen.size(); ++k) {
      how_[static_cast<std::size_t>(cover->chosen[k])] = cover->chosen_how[k];
    }
  }

  explicit operator bool() const { return present_; }
  Choice how(std::int32_t ball) const { return static_cast<Choice>(how_[static_cast<std::size_t>(ball)]); }
  /// The positions of the known balls in the component of `rows`.
  Ids among(const CoverState& state, std::span<const std::int32_t> rows) const {
    Ids positions;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::int32_t ball = state.row_ids[static_cast<std::size_t>(rows[k])];
      if (how_[static_cast<std::size_t>(ball)] != none) positions.push_back(static_cast<std::int32_t>(k));
    }
    return positions;
  }

 private:
  static constexpr std::uint8_t none = 255;
  bool present_;
  std::vector<std::uint8_t> how_;  // of each ball, Choice
};

/// Takes the lower bound and the certificate of `known` over where they are better.
void take_over(CoverState& state, const CoverState& known) {
  if (known.certified_bound() > state.certified_bound()) {
    state.certificate_samples = known.certificate_samples;
    state.certificate_prices = known.certificate_prices;
    state.certificate_groups = known.certificate_groups;
    state.settled_groups = known.settled_groups;
  }
  if (known.lower_bound >= 0) {
    raise_lower_bound(state, known.lower_bound, static_cast<BoundHow>(known.lower_bound_how));
  }
}

}  // namespace

CoverState ip_solve(const CoverState& state, IpSolver& solver, const IpSolveOptions& options,
                    Monitor& monitor, const CoverState* known_cover) {
  monitor.step(0);
  const Known known(state, known_cover);
  const Parts parts(state, monitor);
  Ids chosen;
  std::vector<Choice> chosen_how;
  PricedGroups prices;  // of the components that were solved
  std::int64_t claimed = optimal_choices(state);
  for (std::size_t k = 0; k < parts.count(); ++k) {
    if (k % 1024 == 0) monitor.step(static_cast<double>(k) / static_cast<double>(parts.count()));
    const auto rows = parts.rows(k), columns = parts.columns(k);
    const bool small = static_cast<std::int64_t>(rows.size()) <= options.max_balls;
    ++claimed;  // a component needs a ball
    if (!small && !known) continue;
    const auto choose_row = [&](std::int32_t row, auto how_of) {
      chosen.push_back(row);
      chosen_how.push_back(how_of(state.row_ids[static_cast<std::size_t>(row)]));
    };
    const auto choose_rows = [&](const Ids& positions, auto how_of) {
      for (const std::int32_t p : positions) choose_row(rows[static_cast<std::size_t>(p)], how_of);
    };
    const auto exactly = [&state](std::int32_t) {
      return state.left_out > 0 ? Choice::trusted : Choice::exact;
    };
    if (const std::int32_t whole = small ? parts.whole_row(k) : -1; whole >= 0) {
      choose_row(whole, exactly);
      prices.add(state.column_ids[static_cast<std::size_t>(columns[0])], price_unit);
      prices.close();
      continue;
    }

    const Csr matrix = parts.part(k, monitor).columns;
    Ids best;
    if (known) {
      best = known.among(state, rows);
      if (const auto missed = first_missed(matrix, best)) {
        const std::int32_t column = columns[*missed];
        throw InputError("the known cover does not cover sample " +
                             std::to_string(state.column_ids[static_cast<std::size_t>(column)]) +
                             " by balls of the matrix",
                         "connect a cover that was computed from this matrix to known");
      }
    }
    const auto as_known = [&known](std::int32_t ball) { return known.how(ball); };
    if (!small) {
      choose_rows(best, as_known);
      continue;
    }
    const IpProblem problem{rows.size(), matrix,
                            static_cast<std::int64_t>(known ? best.size() : rows.size() + 1),
                            options.node_limit};
    PartMonitor part(monitor, static_cast<double>(k) / static_cast<double>(parts.count()),
                     static_cast<double>(k + 1) / static_cast<double>(parts.count()));
    const IpAnswer answer = solver.solve(problem, part);
    const std::vector<std::int64_t> priced = whole_prices(problem, answer.duals);
    PricedGroups group;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      group.add(state.column_ids[static_cast<std::size_t>(columns[c])], priced[c]);
    }
    group.close();
    require_sound(problem, answer, group.bound(), k);
    claimed += std::max(answer.lower_bound, group.bound()) - 1;
    if (!answer.finished && !known) continue;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      prices.add(state.column_ids[static_cast<std::size_t>(columns[c])], priced[c]);
    }
    prices.close();
    if (answer.finished) {
      choose_rows(answer.rows.empty() ? best : answer.rows, exactly);
    } else if (!answer.rows.empty()) {
      choose_rows(answer.rows, [](std::int32_t) { return Choice::trusted; });
    } else {
      choose_rows(best, as_known);
    }
  }
  CoverState next = state;
  if (!chosen.empty()) {
    next = choose(state, chosen, Choice::exact, monitor);
    std::vector<std::uint8_t> how(state.chosen_how.begin(), state.chosen_how.end());
    for (const Choice choice : chosen_how) how.push_back(static_cast<std::uint8_t>(choice));
    next.chosen_how = std::move(how);
    settle(next, prices);
  }
  if (known) take_over(next, *known_cover);
  raise_lower_bound(next);
  raise_lower_bound(next, claimed, BoundHow::solver);
  monitor.step(1);
  return next;
}

}  // namespace ballflow::geometry
