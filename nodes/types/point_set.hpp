// The sample S of a surface.
#pragma once

#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

struct PointSet {
  Array<Vec3> points;   // n x 3, model units; finite, pairwise distinct
  Array<Vec3> normals;  // n x 3 unit vectors, or empty when the source had none
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const PointSet& points);

}  // namespace ballflow::geometry
