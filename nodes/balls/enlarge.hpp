// Growing balls, so that a later covering step may drop small features (thesis, 3.5).
#pragma once

#include <cstdint>

#include "balls/pole_bound.hpp"
#include "balls/power_growth.hpp"
#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/bisection.hpp"
#include "types/growth.hpp"
#include "types/point_set.hpp"
#include "types/pole_set.hpp"

namespace ballflow::geometry {

/// How a radius r becomes the enlarged radius.
enum class EnlargeMode {
  additive,        // r + epsilon / 100 * longest edge of the bounding box of the sample (thesis, 3.9.2)
  absolute,        // r + epsilon
  multiplicative,  // r * factor
  pole_bound,      // as additive, but below pole_bounds()
  power_diagram,   // as additive, but stopped by power_growth()
};

struct EnlargeOptions {
  EnlargeMode mode = EnlargeMode::additive;
  // All modes but multiplicative: % of the longest bounding-box edge; absolute: model units. At least 0,
  // where 0 returns the input (power_diagram: with its tolerance); from about 0.1 % on features of a scan
  // begin to disappear, from about 3 % on most of the shape.
  double epsilon = 0.3;
  // multiplicative: at least 1, where 1 returns the input.
  double factor = 1.05;
  PoleBoundOptions pole_bound{};
  PowerGrowthOptions power_diagram{};
};

/// The options with the growth that a search tries next as epsilon. Throws InputError for mode
/// multiplicative, which does not use it.
EnlargeOptions searched(EnlargeOptions options, const Bisection& search);

struct Enlarged {
  Balls balls;  // same order, same centers, same defining samples, no radius smaller than before
  Growth growth;
  std::int64_t unions = 0;  // grown unions whose topology was looked at
};

/// Growth by the same length everywhere gives noise the same significance everywhere; growth by a factor
/// spares thin parts. In the modes with bounds epsilon is a wish, and the bound wins.
/// - `sample` is what the balls were made from: its bounding box is the unit of epsilon in percent, and its
///   points are those of the pole bound. Without points for the other modes
/// - `poles` are those of the sample, labelled or not; without entries for modes other than pole_bound
/// - `diagram`, of the balls with the tolerance of the options, saves mode power_diagram a triangulation;
/// other
///   modes do not look at it
/// Throws InputError for options out of range, a sample or poles that are missing where they are needed,
/// balls that break their invariants, radii that leave the range of doubles, and a diagram of other balls.
Enlarged enlarge(const Balls& balls, const PointSet& sample, const PoleSet& poles,
                 const EnlargeOptions& options, Monitor& monitor = no_monitor(),
                 const PowerDiagram* diagram = nullptr);

}  // namespace ballflow::geometry
