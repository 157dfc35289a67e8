#include "types/growth.hpp"

#include <cmath>

namespace ballflow::geometry {

std::string broken_invariant(const Growth& growth) {
  const std::size_t n = growth.radii.size();
  if (growth.centers.size() != n || growth.grown_radii.size() != n || growth.limits.size() != n ||
      growth.stops.size() != n) {
    return std::to_string(growth.centers.size()) + " centers, " + std::to_string(n) + " radii, " +
           std::to_string(growth.grown_radii.size()) + " grown radii, " +
           std::to_string(growth.limits.size()) + " limits and " + std::to_string(growth.stops.size()) +
           " reasons, they must be as many";
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::string ball = "ball " + std::to_string(i);
    if (!is_finite(growth.centers[i])) return "the center of " + ball + " is not finite";
    if (!(growth.radii[i] >= 0) || !(growth.grown_radii[i] >= growth.radii[i]) ||
        !std::isfinite(growth.grown_radii[i])) {
      return ball + " grows from radius " + std::to_string(growth.radii[i]) + " to " +
             std::to_string(growth.grown_radii[i]);
    }
    if (!(growth.limits[i] >= 0)) return "the limit of " + ball + " is " + std::to_string(growth.limits[i]);
    if (growth.stops[i] > static_cast<std::uint8_t>(GrowthStop::neighbour)) {
      return ball + " stopped for reason " + std::to_string(growth.stops[i]) + ", there are 0 to 3";
    }
  }
  return {};
}

}  // namespace ballflow::geometry
