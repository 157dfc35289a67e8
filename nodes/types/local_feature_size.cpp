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
