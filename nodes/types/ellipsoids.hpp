// A set of closed ellipsoids.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/array.hpp"
#include "base/rotation.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Ellipsoid i is the image of the closed unit ball under u -> centers[i] + R_i (radii[i].x u.x,
/// radii[i].y u.y, radii[i].z u.z), R_i the rotation rotations[i]. Each has a rotation of its own, so that
/// pieces of an object may have axes of their own.
struct Ellipsoids {
  Array<Vec3> centers;          // n x 3, model units; finite
  Array<Vec3> radii;            // n x 3: half-axes along the axes of the rotation, model units, > 0
  Array<Quaternion> rotations;  // n x 4: w x y z, of length 1 to 1e-9

  std::size_t size() const { return centers.size(); }
};

/// Ellipsoids `ids` of `all`, in that order.
Ellipsoids select(const Ellipsoids& all, std::span<const std::int32_t> ids);

/// The tight bounding box of one ellipsoid, enlarged by what rounding can do (2^-48 of its largest number).
Box bounding_box(const Ellipsoids& all, std::size_t i);
/// Of the union.
Box bounding_box(const Ellipsoids& all);

/// Sum of the volumes of all, whatever they share; cubed model units.
double sum_of_volumes(const Ellipsoids& all);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const Ellipsoids& all);

}  // namespace ballflow::geometry
