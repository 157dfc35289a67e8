// What the Minkowski sum of two sets of balls came to.
#pragma once

#include <cstdint>
#include <string>

#include "base/vec3.hpp"

namespace ballflow::geometry {

struct MinkowskiReport {
  std::int64_t pairs = 0;  // |A| * |B|
  std::int64_t survivors =
      0;  // sums that had to be triangulated; algorithm memory: that were still vertices at the end
  std::int64_t count = 0;  // sums that contribute
  // Contributing sums with a piece of their sphere, for radius 0 their point, on the boundary of the union.
  std::int64_t touching_boundary = 0;
  Vec3 lower, upper;  // of the bounding box of the union, model units; 0 for no balls

  // No point of the surface of A + B is farther than this from the union, where A and B are the solids that
  // the balls stand for; negative: unknown. Model units.
  double error_bound = -1;
};

/// Empty when the numbers can be true, else what is wrong.
std::string broken_invariant(const MinkowskiReport& report);

}  // namespace ballflow::geometry
