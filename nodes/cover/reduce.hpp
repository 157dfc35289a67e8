// Reductions of a set covering instance that keep its optimum (Kornberger 2010, 3.6.1 and 3.8.2).
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/cover_state.hpp"

namespace ballflow::geometry {

/// How the candidates of a subset test are found. All give the same residual.
enum class SubsetTest : std::uint8_t {
  inverted_index,  // the sets that contain the rarest element of the set
  hash,            // all sets, filtered by signatures of 64 sections (thesis, 3.8.2): quadratic
  bandwidth,       // the sets near it after a permutation that reduces the bandwidth (thesis, Listing 3.3)
};

struct ReduceOptions {
  SubsetTest subset_test = SubsetTest::inverted_index;
};

/// What finding candidates was good for. Threads may mark sets in any order, so the numbers of one run may
/// differ a little from those of the next.
struct ReduceStatistics {
  std::int64_t candidates = 0;  // pairs of sets that were looked at
  std::int64_t compared = 0;    // pairs whose elements were compared
  std::int64_t passes = 0;      // over the rows or the columns
};

/// Applies three rules in synchronous passes, in this order, until none of them applies:
///   - rows: only maximal rows stay; a row inside another one, or equal to an earlier one, or empty, goes;
///   - columns: only minimal columns stay; a column that contains another one, or equals an earlier one,
///   goes;
///   - essentials: a row that is alone in a column is chosen (Choice::essential), ascending within a pass,
///     and goes with all its columns.
/// Every rule looks at the matrix its pass began with, so the residual is a function of the input alone.
/// Raises the lower bound by the essential choices (see raise_lower_bound); the certificate gets the sample
/// that only the essential ball covered, for each (see certificate.hpp).
CoverState reduce(const CoverState& state, const ReduceOptions& options = {}, Monitor& monitor = no_monitor(),
                  ReduceStatistics* statistics = nullptr);

}  // namespace ballflow::geometry
