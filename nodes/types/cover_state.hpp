// The state of a set covering computation (thesis, 3.6): what is left of the covering matrix, what was
// chosen, and what was proved so far. Every pruning node maps a CoverState to a CoverState.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "types/array.hpp"

namespace ballflow::geometry {

/// How a ball came to be chosen.
enum class Choice : std::uint8_t {
  essential = 0,  // the only ball left that covers some sample (optimality kept)
  exact = 1,      // part of a proven optimal solution of a component
  greedy = 2,     // a greedy pick: each may cost one ball more than the optimum (Lemma 3.7)
  trusted = 3,    // from a solver that stopped before it proved optimality
  all = 4,        // kept because nothing was pruned
};

struct CoverState {
  std::int64_t balls = 0;    // number of balls of the original instance
  std::int64_t samples = 0;  // number of samples of the original instance

  // Residual matrix, rows = balls, columns = samples, compressed by rows, every row ascending. Row i
  // covers columns[row_offsets[i] .. row_offsets[i + 1]), which index column_ids.
  Array<std::int64_t> row_offsets;  // rows + 1 (one 0 for no rows)
  Array<std::int32_t> columns;      // nnz
  Array<std::int32_t> row_ids;      // rows: index of the ball in the original instance, ascending
  Array<std::int32_t> column_ids;   // cols: index of the sample in the original instance, ascending

  Array<std::int32_t> chosen;      // k balls (original indices), in the order in which they were chosen
  Array<std::uint8_t> chosen_how;  // k, Choice

  Array<std::int32_t> uncovered;  // samples (original indices) that no ball covers; they are in no column

  // Proven: every cover of the original instance has at least so many balls; -1 while nothing is known.
  // Valid for the whole instance, not for the residual.
  std::int64_t lower_bound = -1;
  // 1 while everything chosen except the greedy picks was proven optimal, so that Lemma 3.7 applies.
  std::uint8_t exact_so_far = 1;

  std::size_t rows() const { return row_ids.size(); }
  std::size_t cols() const { return column_ids.size(); }
  std::size_t nnz() const { return columns.size(); }
  std::size_t remaining() const { return column_ids.size(); }  // samples not yet covered by `chosen`
  std::span<const std::int32_t> row(std::size_t i) const {
    const auto first = static_cast<std::size_t>(row_offsets[i]);
    return columns.span().subspan(first, static_cast<std::size_t>(row_offsets[i + 1]) - first);
  }
  std::int64_t count(Choice how) const;
  /// Number of chosen balls once nothing remains, else nothing.
  std::optional<std::int64_t> upper_bound() const;
  /// (upper - lower) / lower, a fraction, once both are known.
  std::optional<double> gap() const;
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const CoverState& state);

}  // namespace ballflow::geometry
