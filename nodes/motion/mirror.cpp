#include "motion/mirror.hpp"

#include <utility>
#include <vector>

namespace ballflow::geometry {

Balls mirrored(const Balls& balls) {
  std::vector<Vec3> centers;
  centers.reserve(balls.size());
  // 0 - 0 is 0, and not -0, which would be other bytes for the same place.
  for (const Vec3& c : balls.centers) centers.push_back(Vec3{} - c);
  return {std::move(centers), balls.radii, {}, {}};
}

}  // namespace ballflow::geometry
