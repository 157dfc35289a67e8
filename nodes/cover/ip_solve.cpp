#include "cover/ip_solve.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "cover/components.hpp"

namespace ballflow::geometry {
namespace {

using Ids = std::vector<std::int32_t>;

/// The members of each group, ascending: group of i -> list of i. Negative groups are left out.
Csr grouped(const Ids& group_of, const Ids& sizes) {
  std::vector<std::int64_t> offsets(sizes.size() + 1);
  for (std::size_t g = 0; g < sizes.size(); ++g) offsets[g + 1] = offsets[g] + sizes[g];
  std::vector<std::int64_t> next(offsets.begin(), offsets.end() - 1);
  Ids members(static_cast<std::size_t>(offsets.back()));
  for (std::size_t i = 0; i < group_of.size(); ++i) {
    if (group_of[i] < 0) continue;
    const auto g = static_cast<std::size_t>(group_of[i]);
    members[static_cast<std::size_t>(next[g]++)] = static_cast<std::int32_t>(i);
  }
  return {std::move(offsets), std::move(members)};
}

/// The columns of the submatrix of `rows`, as sets of positions in `rows`. `number` has room for all columns.
Csr columns_of(const CoverState& state, std::span<const std::int32_t> rows,
               std::span<const std::int32_t> columns, Ids& number) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    number[static_cast<std::size_t>(columns[k])] = static_cast<std::int32_t>(k);
  }
  std::vector<std::int64_t> offsets{0};
  Ids entries;
  for (const std::int32_t i : rows) {
    for (const std::int32_t c : state.row(static_cast<std::size_t>(i))) {
      entries.push_back(number[static_cast<std::size_t>(c)]);
    }
    offsets.push_back(static_cast<std::int64_t>(entries.size()));
  }
  return transpose({std::move(offsets), std::move(entries)}, columns.size());
}

/// Throws unless every column contains one of `rows`: a solver is never taken at its word.
void require_cover(const Csr& columns, const Ids& rows, std::size_t component, std::size_t balls) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const auto column = columns[c];
    const bool met = std::any_of(column.begin(), column.end(), [&](std::int32_t i) {
      return std::binary_search(rows.begin(), rows.end(), i);
    });
    if (met) continue;
    throw InputError(
        "the solver's answer for component " + std::to_string(component) + " leaves column " +
            std::to_string(c) + " of " + std::to_string(columns.size()) + " uncovered",
        "this is a bug of the solver: set max_balls below " + std::to_string(balls) + " and report it");
  }
}

}  // namespace

CoverState ip_solve(const CoverState& state, IpSolver& solver, const IpSolveOptions& options,
                    Monitor& monitor) {
  monitor.step(0);
  const Components parts = components(state);
  const Csr rows_in = grouped(parts.of_row, parts.rows), columns_in = grouped(parts.of_column, parts.columns);
  Ids chosen, number(state.cols());
  for (std::size_t k = 0; k < parts.count(); ++k) {
    if (k % 1024 == 0) monitor.step(static_cast<double>(k) / static_cast<double>(parts.count()));
    if (parts.rows[k] > options.max_balls) continue;
    const auto rows = rows_in[k], columns = columns_in[k];
    const auto whole = std::find_if(rows.begin(), rows.end(), [&](std::int32_t i) {
      return state.row(static_cast<std::size_t>(i)).size() == columns.size();
    });
    if (whole != rows.end()) {
      chosen.push_back(*whole);
      continue;
    }
    const Csr problem = columns_of(state, rows, columns, number);
    const IpAnswer answer = solver.solve(rows.size(), problem, options.node_limit, monitor);
    if (!answer.proven) continue;
    require_cover(problem, answer.rows, k, rows.size());
    for (const std::int32_t i : answer.rows) chosen.push_back(rows[static_cast<std::size_t>(i)]);
  }
  if (chosen.empty()) return state;
  CoverState next = choose(state, chosen, Choice::exact);
  raise_lower_bound(next);
  monitor.step(1);
  return next;
}

}  // namespace ballflow::geometry
