// Whether points fill space: four of them that are not in one plane.
#pragma once

#include <span>

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Dimension of the affine hull of the points: -1 (none), 0, 1, 2 or 3. Decided exactly.
///
/// - the points must be finite; equal ones are allowed
int affine_dimension(std::span<const Vec3> points);

/// Throws InputError for fewer than four points and for points in one place, on one line or in one plane.
///
/// - the points must be finite and pairwise distinct
void require_space_filling(std::span<const Vec3> points);

}  // namespace ballflow::geometry
