#include "types/local_feature_size.hpp"

#include <cmath>

namespace ballflow::geometry {

std::string broken_invariant(const LocalFeatureSize& size) {
  if (size.points.size() != size.pole_distances.size()) {
    return std::to_string(size.points.size()) + " points but " + std::to_string(size.pole_distances.size()) +
           " distances";
  }
  if (size.points.size() != size.third_neighbors.size()) {
    return std::to_string(size.points.size()) + " points but " + std::to_string(size.third_neighbors.size()) +
           " distances to third neighbours";
  }
  if (!size.axis_distances.empty() && size.points.size() != size.axis_distances.size()) {
    return std::to_string(size.points.size()) + " points but " + std::to_string(size.axis_distances.size()) +
           " distances to the medial axis";
  }
  for (std::size_t i = 0; i < size.axis_distances.size(); ++i) {
    if (size.axis_distances[i] >= 0 && std::isfinite(size.axis_distances[i])) continue;
    return "the distance of point " + std::to_string(i) + " to the medial axis is " +
           std::to_string(size.axis_distances[i]);
  }
  if (size.r_at_least != -1 || size.r_at_most != -1) {
    if (!(size.r_at_least >= 0 && size.r_at_most >= size.r_at_least && std::isfinite(size.r_at_least))) {
      return "r is from " + std::to_string(size.r_at_least) + " to " + std::to_string(size.r_at_most);
    }
  }
  if (size.fewer_poles > 1) return "fewer_poles is " + std::to_string(size.fewer_poles) + ", not 0 or 1";
  if (!is_finite(size.r_at)) return "the point where r is attained is not finite";
  for (std::size_t i = 0; i < size.points.size(); ++i) {
    if (!(size.third_neighbors[i] > 0)) {
      return "the distance of point " + std::to_string(i) + " to its third neighbour is " +
             std::to_string(size.third_neighbors[i]);
    }
    if (!is_finite(size.points[i])) return "point " + std::to_string(i) + " is not finite";
    const double distance = size.pole_distances[i];
    if (!(distance > 0) || !std::isfinite(distance)) {
      return "the distance of point " + std::to_string(i) + " to its nearest pole is " +
             std::to_string(distance);
    }
  }
  return {};
}

}  // namespace ballflow::geometry
