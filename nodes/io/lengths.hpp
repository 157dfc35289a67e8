// Scales and tolerances as users write them.
#pragma once

#include <string_view>

#include "base/monitor.hpp"

namespace ballflow::geometry {

/// "1000", or the unit of the lengths in a file, which become metres: um, mm, cm, dm, m, km, mil, in, ft, yd.
/// The factor is finite and above 0. Throws InputError for other text.
double parse_scale(std::string_view text);

/// A length in model units, or a share of the longest edge of a bounding box.
struct Tolerance {
  double value = 0;
  bool relative = false;

  double length(double longest_edge) const { return relative ? value * longest_edge : value; }
};

/// "1e-6", or "0.01%" of the longest edge of the bounding box; finite and at least 0, and below 100 %. Throws
/// InputError for other text.
Tolerance parse_tolerance(std::string_view text);

}  // namespace ballflow::geometry
