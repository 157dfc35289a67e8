// A given number of balls instead of a given growth.
#pragma once

#include <cstdint>
#include <optional>

#include "base/monitor.hpp"
#include "types/bisection.hpp"
#include "types/cover_state.hpp"

namespace ballflow::geometry {

struct BisectOptions {
  // No more balls than this.
  std::int64_t balls = 500;
  // Good enough are `balls` (1 - tolerance) or more.
  double tolerance = 0.02;
  // The value to try first, and the largest one.
  double start = 0.3;
  double largest = 100;
};

/// The state of a search before anything was tried.
Bisection begin_bisection(const BisectOptions& options);

/// The state after `cover` was made with search.value: fewer balls are needed the larger the value.
/// - Values are tried in steps of a factor of 4 until there is one on either side, then halfway in ratios
/// - The search is done when a value needs at most `balls` and at least balls (1 - tolerance); when the two
///   sides are within 0.1 % (the number of balls jumps there); or when 0 needs few enough. Its value is then
///   the smallest one known to need at most `balls`; the number is monotone but for what the pruning leaves
///   undecided, so a smaller one may exist
/// Throws InputError for options out of range, a cover that is not finished, and when the largest value
/// needs more balls. A search that is done stays as it is.
Bisection bisect(const Bisection& search, const CoverState& cover, const BisectOptions& options,
                 Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
