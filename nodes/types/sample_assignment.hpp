// Which vertex of a surface every sample belongs to.
#pragma once

#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

struct SampleAssignment {
  Array<Vec3> points;            // n x 3, the samples, model units
  Array<std::int32_t> balls;     // n: the ball to which the sample has the least power
  Array<std::int32_t> vertices;  // n: the vertex of the surface that it belongs to; empty without a surface
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const SampleAssignment& assignment);

}  // namespace ballflow::geometry
