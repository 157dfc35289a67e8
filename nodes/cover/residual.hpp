// Steps that every pruning method shares: choosing rows, and what that proves about the optimum.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/cover_state.hpp"

namespace ballflow::geometry {

/// Compressed sets of integers: the rows of a matrix, or its columns.
struct Csr {
  Array<std::int64_t> offsets{0};
  Array<std::int32_t> entries;

  std::size_t size() const { return offsets.size() - 1; }
  std::size_t degree(std::size_t i) const { return static_cast<std::size_t>(offsets[i + 1] - offsets[i]); }
  std::span<const std::int32_t> operator[](std::size_t i) const {
    return entries.span().subspan(static_cast<std::size_t>(offsets[i]), degree(i));
  }
};

/// The rows of the residual matrix, not copied.
inline Csr rows_of(const CoverState& state) { return {state.row_offsets, state.columns}; }

/// The columns of a matrix given by its rows (or the reverse), each ascending.
Csr transpose(const Csr& rows, std::size_t columns, Monitor& monitor = no_monitor());

/// `size` zeros. The pages of a large array are made piece by piece: gigabytes take seconds.
template <class T>
std::vector<T> zeros(std::size_t size, Monitor& monitor) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  std::vector<T> values;
  values.reserve(size);
  while (values.size() < size) {
    if (monitor.cancelled()) throw Cancelled();
    values.resize(std::min(size, values.size() + piece));
  }
  return values;
}

/// Appends `rows` (distinct indices into the residual matrix) to the chosen balls, in that order, and takes
/// out of the matrix these rows, the columns they cover, and rows that then cover nothing. Counts and
/// bounds follow by raise_lower_bound.
CoverState choose(const CoverState& state, std::span<const std::int32_t> rows, Choice how,
                  Monitor& monitor = no_monitor());

/// Raises the lower bound to what the choices and the residual prove, if that is more.
///
/// Let e be the number of essential and exact choices, R the residual. Then every cover of the original
/// instance has at least e + OPT(R) balls: reductions keep the optimum; an essential choice, or an optimal
/// solution of a component, lowers it by its size; and any other choice only removes a row
/// and the columns it covers, which never raises the optimum of what is left. This is Lemma 3.7 of the
/// thesis for any interleaving of exact and greedy steps: with an empty residual, e = |solution| - g.
/// OPT(R) >= ceil(columns / longest row).
void raise_lower_bound(CoverState& state);

/// Takes `bound` over when it is more than the lower bound known, or as much on better ground. Of a matrix
/// that leaves balls out only what a certificate proves: these and the next do nothing else with it.
void raise_lower_bound(CoverState& state, std::int64_t bound, BoundHow how);

/// e of above: the essential and exact choices.
std::int64_t optimal_choices(const CoverState& state);

}  // namespace ballflow::geometry
