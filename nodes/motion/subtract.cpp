#include "motion/subtract.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "exact/separation.hpp"
#include "motion/ball_boxes.hpp"
#include "motion/near_pairs.hpp"

namespace ballflow::geometry {
namespace {

void check_side(const char* name, const Balls& balls) {
  if (std::string why = broken_invariant(balls); !why.empty())
    throw InputError(std::string("the balls of ") + name + " cannot be used: " + why,
                     "look for the step that made them");
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 c = balls.centers[i];
    if (std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z), balls.radii[i]}) > largest_separable)
      throw InputError(
          "ball " + std::to_string(i) + " of " + name + " has a coordinate or a radius beyond 1e140",
          "use another unit of length");
  }
}

}  // namespace

Balls subtracted(const Balls& a, const Balls& b, Monitor& monitor) {
  check_side("a", a);
  check_side("b", b);
  if (a.size() == 0 || b.size() == 0) return {a.centers, a.radii, {}, {}};
  // Which ball is nearest to a center does not depend on the radius around it.
  const Balls points{a.centers, std::vector<double>(a.size(), 0.0), {}, {}};
  const BallBoxes boxes_a(points, monitor), boxes_b(b, monitor);
  PartMonitor part(monitor, 0.2, 0.9);
  const std::vector<NearPair> nearest = nearest_of_every(boxes_a, boxes_b, part);
  std::vector<double> distances(a.size());
  for_each_block(a.size(), 4096, monitor, 0.9, 1, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) distances[i] = separation_at_least(nearest[i].balls);
  });
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(distances[i] > 0)) continue;
    centers.push_back(a.centers[i]);
    radii.push_back(std::min(a.radii[i], distances[i]));
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

}  // namespace ballflow::geometry
