// What a solid of density 1 weighs, and how it turns.
#pragma once

#include <array>
#include <string>

#include "base/vec3.hpp"

namespace ballflow::geometry {

struct MassProperties {
  double volume = 0;    // cubed model units
  double area = 0;      // of the boundary, squared model units
  Vec3 center_of_mass;  // model units; the origin when the volume is 0

  // Inertia tensor about the centre of mass at density 1, model units to the fifth power: xx, yy, zz, xy, xz,
  // yz. Off the diagonal stand minus the integrals of products, as mechanics writes the tensor.
  std::array<double, 6> inertia{};

  // Length of the integral of the outward normal over the boundary, divided by the area: 0 but for rounding,
  // because the boundary is closed.
  double closure_error = 0;
};

/// Empty when every number is finite and none is negative that cannot be, else what is wrong.
std::string broken_invariant(const MassProperties& properties);

}  // namespace ballflow::geometry
