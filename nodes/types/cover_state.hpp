// The state of a set covering computation (thesis, 3.6): what is left of the covering matrix, what was
// chosen, and what was proved so far. Every pruning node maps a CoverState to a CoverState.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/array.hpp"

namespace ballflow::geometry {

/// How a ball came to be chosen.
enum class Choice : std::uint8_t {
  essential = 0,  // the only ball left that covers some sample (optimality kept)
  exact = 1,      // part of a proven optimal solution of a component
  greedy = 2,     // a greedy pick: each may cost one ball more than the optimum (Lemma 3.7)
  trusted = 3,    // from a solver that stopped before it proved optimality
  all = 4,        // kept because nothing was pruned
  searched = 5,  // kept by local search, or needed by a matrix without all balls: nothing is claimed about it
  returned = 6,  // returned after the cover was finished, to keep the topology of the union
};

/// How a lower bound was obtained, the weakest ground first.
enum class BoundHow : std::uint8_t {
  unknown = 0,    // there is none
  solver = 1,     // a solver said so: a component's optimum, or the bound of an unfinished search
  lemma_3_7 = 2,  // essential and exact choices counted, and columns / longest row of what is left
  share = 3,      // the share bound (Theorem 3.8)
  certified = 4,  // the certificate of the state proves it: anybody can check that
};

/// The price of a sample in a certificate is an integer number of 1 / price_unit balls.
inline constexpr std::int64_t price_unit = std::int64_t{1} << 20;

struct CoverState {
  std::int64_t balls = 0;    // number of balls of the original instance
  std::int64_t samples = 0;  // number of samples of the original instance
  // Balls that are no row although they may cover samples of columns, because the matrix would be too large.
  // While there are any, what a reduction or a solver finds out about the matrix proves nothing about the
  // instance: it raises no bound, and no choice is essential or exact.
  std::int64_t left_out = 0;

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
  std::uint8_t lower_bound_how = 0;  // BoundHow

  // Certificate of a lower bound: sample certificate_samples[i] (original index) has the price
  // certificate_prices[i] / price_unit, in group certificate_groups[i]. If
  //   (1) no ball of the original instance contains samples whose prices sum to more than 1,
  //   (2) no ball of the original instance contains listed samples of two groups, (3) each is in one,
  // then a cover needs at least ceil(sum of prices) balls for each group, and no ball serves two groups:
  // every cover has at least certified_bound() balls. Samples that are not listed are free.
  Array<std::int32_t> certificate_samples;  // l samples, ascending within a group, none twice
  Array<std::int32_t> certificate_prices;   // l, from 1 to price_unit
  Array<std::int32_t> certificate_groups;   // l, ascending, from 0 without holes
  // The first groups are about samples that essential and exact choices took out of the matrix: no ball
  // contains one of these samples and one of column_ids. The groups after them say something about the matrix
  // as it was when they were made.
  std::int64_t settled_groups = 0;

  std::size_t rows() const { return row_ids.size(); }
  std::size_t cols() const { return column_ids.size(); }
  std::size_t nnz() const { return columns.size(); }
  std::size_t remaining() const { return column_ids.size(); }  // samples not yet covered by `chosen`
  std::span<const std::int32_t> row(std::size_t i) const {
    const auto first = static_cast<std::size_t>(row_offsets[i]);
    return columns.span().subspan(first, static_cast<std::size_t>(row_offsets[i + 1]) - first);
  }
  std::int64_t count(Choice how) const;
  /// What the certificate proves, 0 when it is empty.
  std::int64_t certified_bound() const;
  /// Number of chosen balls once nothing remains, else nothing.
  std::optional<std::int64_t> upper_bound() const;
  /// (upper - lower) / lower, a fraction, once both are known.
  std::optional<double> gap() const;
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const CoverState& state);

}  // namespace ballflow::geometry
