#include "cover/bisect.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace ballflow::geometry {
namespace {

constexpr double step = 4;              // between values until there is one on either side
constexpr double negligible = 0x1p-20;  // smaller than this times the start is as good as 0
constexpr double resolution = 0x1p-10;  // the sides are not told apart when they are nearer, in ratio

void check(const BisectOptions& options) {
  if (options.balls < 1) {
    throw InputError("balls is " + std::to_string(options.balls), "ask for at least one ball");
  }
  if (!(options.tolerance >= 0 && options.tolerance < 1)) {
    throw InputError("tolerance is " + std::to_string(options.tolerance), "use a fraction in [0, 1)");
  }
  if (!(options.start > 0 && options.largest >= options.start && std::isfinite(options.largest))) {
    throw InputError(
        "start is " + std::to_string(options.start) + " and largest is " + std::to_string(options.largest),
        "use 0 < start <= largest");
  }
}

Bisection done(Bisection search) {
  search.value = search.large_enough;
  search.done = 1;
  return search;
}

/// The value to try next, or the end of the search.
Bisection advance(Bisection search, const BisectOptions& options) {
  if (search.large_enough < 0) {
    if (search.too_small >= options.largest) {
      throw InputError("growth by " + std::to_string(options.largest) +
                           ", the largest allowed, still needs " + std::to_string(search.balls_before) +
                           " balls, not " + std::to_string(options.balls),
                       "allow more growth, or ask for more balls");
    }
    search.value = std::min(step * search.too_small, options.largest);
    return search;
  }
  if (search.too_small < 0) {
    if (search.large_enough == 0) return done(search);
    const double smaller = search.large_enough / step;
    search.value = smaller < negligible * options.start ? 0 : smaller;
    return search;
  }
  if (search.large_enough - search.too_small <= resolution * search.large_enough) return done(search);
  search.value =
      std::sqrt(std::max(search.too_small, negligible * options.start)) * std::sqrt(search.large_enough);
  if (search.value <= search.too_small || search.value >= search.large_enough) return done(search);
  return search;
}

}  // namespace

Bisection begin_bisection(const BisectOptions& options) {
  check(options);
  Bisection search;
  search.value = options.start;
  return search;
}

Bisection bisect(const Bisection& before, const CoverState& cover, const BisectOptions& options,
                 Monitor& monitor) {
  check(options);
  if (before.done == 1) return before;
  if (cover.remaining() != 0) {
    throw InputError(std::to_string(cover.remaining()) + " samples are not covered yet",
                     "use a pruning strategy that covers all samples");
  }
  Bisection search = before;
  ++search.tried;
  const auto needed = static_cast<std::int64_t>(cover.chosen.size());
  const auto enough = (1 - options.tolerance) * static_cast<double>(options.balls);
  if (needed > options.balls) {
    search.too_small = search.value;
    search.balls_before = needed;
  } else {
    search.large_enough = search.value;
    search.balls = needed;
  }
  const auto close = [&] { return search.balls >= 0 && static_cast<double>(search.balls) >= enough; };
  search = close() ? done(search) : advance(search, options);
  if (search.done == 1 && !close()) {
    monitor.warn(search.value == 0
                     ? "without any growth " + std::to_string(search.balls) +
                           " balls are enough, fewer than the " + std::to_string(options.balls) + " asked for"
                     : "the number of balls jumps from " + std::to_string(search.balls_before) + " to " +
                           std::to_string(search.balls) + " at a growth of " + std::to_string(search.value));
  }
  return search;
}

}  // namespace ballflow::geometry
