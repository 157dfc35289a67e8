// What the Minkowski sum of two sets of balls came to.
#pragma once

#include <cstdint>
#include <string>

#include "base/vec3.hpp"
#include "types/comparison.hpp"

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
  // ComparedWith: what the balls of a and of b were compared with. A solid that was compared with nothing is
  // the union of its balls.
  std::uint8_t a_compared_with = 0, b_compared_with = 0;
};

/// Why there is no error bound; empty when there is one. A bound needs a comparison, and every comparison
/// must be with a closed mesh: points and open meshes are no boundary of a solid.
std::string why_unbounded(ComparedWith a, ComparedWith b);

/// Empty when the numbers can be true, else what is wrong.
std::string broken_invariant(const MinkowskiReport& report);

}  // namespace ballflow::geometry
