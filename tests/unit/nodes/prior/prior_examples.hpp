// Points, poses and shapes for the tests of shape priors.
#pragma once

#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "types/shape_pose.hpp"

namespace ballflow::geometry {

/// n points of the unit cube.
inline std::vector<Vec3> random_points(Random& random, std::size_t n) {
  std::vector<Vec3> points(n);
  for (Vec3& p : points) p = {random.unit(), random.unit(), random.unit()};
  return points;
}

/// A rotation, uniform among all (of a random quaternion in the unit ball), and a translation.
inline ShapePose random_pose(Random& random, double scale = 1, double shift = 1) {
  double q[4], n;
  do {
    n = 0;
    for (double& x : q) {
      x = 2 * random.unit() - 1;
      n += x * x;
    }
  } while (n > 1 || n < 0.01);
  for (double& x : q) x /= std::sqrt(n);
  const auto [w, x, y, z] = q;
  ShapePose pose;
  pose.rotation = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                   2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                   2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  pose.scale = scale;
  pose.similarity = scale == 1 ? 0 : 1;
  pose.translation = shift * Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
  return pose;
}

}  // namespace ballflow::geometry
