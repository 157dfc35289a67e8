#include "types/path.hpp"

#include <cmath>
#include <cstddef>

namespace ballflow::geometry {

double length(const Path& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path.points[i - 1], path.points[i]);
  return sum;
}

std::string broken_invariant(const Path& path) {
  if (path.size() == 0) return "a path without points";
  if (path.radii.size() != path.size()) return "not as many radii as points";
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!is_finite(path.points[i])) return "point " + std::to_string(i) + " is not finite";
    if (!(path.radii[i] >= 0) || !std::isfinite(path.radii[i]))
      return "the radius of point " + std::to_string(i) + " is negative or not finite";
    if (i > 0 && path.points[i] == path.points[i - 1])
      return "point " + std::to_string(i) + " is where the one before it is";
  }
  if (path.balls < 0) return "the number of balls is negative";
  if (path.contains > 1) return "contains is " + std::to_string(path.contains) + ", not 0 or 1";
  if (!(path.spacing >= 0) || !std::isfinite(path.spacing) || !(path.error >= 0) ||
      !std::isfinite(path.error))
    return "the spacing or the error is negative, or not finite";
  return {};
}

}  // namespace ballflow::geometry
