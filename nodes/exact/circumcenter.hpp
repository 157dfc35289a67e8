// Circumcentres of tetrahedra and of triangles in the plane.
#pragma once

#include <array>

#include "base/vec2.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// The point at equal distance from four points that lie in no plane, wrong by some 1e-12 of the size of the
/// tetrahedron at most: where it is flat, rational numbers are asked. How it is rounded depends on the order
/// of the points.
Vec3 circumcenter(const std::array<Vec3, 4>& points);

/// The same of three points that are not on one line.
Vec2 circumcenter(const std::array<Vec2, 3>& points);

}  // namespace ballflow::geometry
