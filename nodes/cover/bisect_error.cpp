#include "cover/bisect_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace ballflow::geometry {
namespace {

constexpr double largest = 10;         // growth in %: beyond it little of a shape remains
constexpr double negligible = 0x1p-6;  // of what is allowed: a growth below that is as good as none
constexpr double resolution = 0.02;    // the sides are not told apart when they are nearer, in ratio
constexpr std::int64_t most_trials = 16;

void check_options(const BisectErrorOptions& options, double edge) {
  const auto number = [](double x) { return std::to_string(x); };
  if (!(options.max_error >= 0 && std::isfinite(options.max_error)))
    throw InputError("max_error is " + number(options.max_error), "give a length in model units, or 0");
  if (!(options.share > 0 && options.share <= 1))
    throw InputError("share is " + number(options.share), "use a fraction in (0, 1]");
  if (!(options.epsilon >= 0 && std::isfinite(options.epsilon)))
    throw InputError("epsilon is " + number(options.epsilon), "use a growth of 0 or more");
  if (!(options.tolerance >= 0 && options.tolerance < 1))
    throw InputError("tolerance is " + number(options.tolerance), "use a fraction in [0, 1)");
  if (options.max_error > 0 && !(edge > 0))
    throw InputError("the samples are one point, so that no growth can be told in % of their box",
                     "give a sample with an extent");
}

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

Bisection finished(Bisection search) {
  search.value = search.within;
  search.done = 1;
  return search;
}

/// The growth to try next, or the end of the search. `percent`: of the box, what is allowed.
Bisection next(Bisection search, const BisectErrorOptions& options, double percent, double edge) {
  const double allowed = options.allowed();
  if (search.within < 0) {
    if (search.value == 0) {
      const double error = search.error_before;
      throw InputError("without any growth the balls are still " + short_number(error) + " off, not the " +
                           short_number(allowed) + " that are allowed (" + short_number(options.share) +
                           " of max_error)",
                       "ask for a max_error of " + short_number(1.01 * error / options.share) +
                           " or more, or sample more densely (a smaller delta, or in the plane spacing)");
    }
    const double aimed = search.value - 100 * (search.error_before - allowed) / edge;
    search.value = search.tried < 3 ? std::max(aimed, search.value / 4) : search.value / 4;
    if (search.value < negligible * percent) search.value = 0;
    return search;
  }
  const bool enough = search.error >= (1 - options.tolerance) * allowed;
  if (enough || search.tried >= most_trials) return finished(search);
  if (search.beyond < 0) {
    if (search.within >= largest) return finished(search);
    const double aimed = search.within + 100 * (allowed - search.error) / edge;
    search.value = std::min(std::max(aimed, (search.tried < 3 ? 1.2 : 2) * search.within), largest);
    return search;
  }
  const double gap = search.beyond - search.within;
  if (gap <= std::max(resolution * search.beyond, negligible * percent)) return finished(search);
  // A little less than what is allowed, where the error is linear.
  const double aim = (1 - options.tolerance / 2) * allowed;
  const double part = (aim - search.error) / (search.error_before - search.error);
  search.value = search.within + gap * std::clamp(part, 0.1, 0.9);
  return search;
}

}  // namespace

double proven_error(const Enclosure& enclosure) {
  if (const std::string broken = broken_invariant(enclosure); !broken.empty())
    throw InputError("the enclosure is damaged: " + broken, "compute it again");
  if (enclosure.triangles == 0 || enclosure.closed == 0)
    throw InputError(std::string("nothing bounds the error of balls for ") +
                         (enclosure.triangles == 0 ? "points" : "an open mesh"),
                     "close the mesh or wrap it (sampling=wrap), make one of points by "
                     "graphs/reconstruct.json, or choose epsilon in place of max_error");
  if (enclosure.balls == 0)
    throw InputError("there are no balls, so that nothing bounds their error", "give one at least");
  return std::max(enclosure.gap_at_most, enclosure.protrusion);
}

Bisection begin_error_search(const BisectErrorOptions& options, double edge) {
  check_options(options, edge);
  Bisection search;
  if (options.max_error == 0) {
    search.value = options.epsilon;
    search.done = 1;
    return search;
  }
  search.value = std::min(50 * options.allowed() / edge, largest);
  return search;
}

Bisection bisect_error(const Bisection& before, const Enclosure& enclosure, const BisectErrorOptions& options,
                       double edge, Monitor& monitor) {
  check_options(options, edge);
  if (before.done == 1) return before;
  Bisection search = before;
  ++search.tried;
  const double error = proven_error(enclosure);
  if (error <= options.allowed()) {
    search.within = search.value;
    search.error = error;
  } else {
    search.beyond = search.value;
    search.error_before = error;
  }
  monitor.note("growth " + short_number(search.value) + " %: error " + short_number(error) + ", " +
               std::to_string(enclosure.balls) + " balls");
  return next(search, options, 100 * options.allowed() / edge, edge);
}

}  // namespace ballflow::geometry
