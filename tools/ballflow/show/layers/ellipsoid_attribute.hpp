// How thick ellipsoids are: what they are coloured by.
#pragma once

#include <algorithm>

#include "show/scene.hpp"
#include "types/ellipsoids.hpp"

namespace ballflow::show {

/// One value per ellipsoid.
inline Attribute shortest_axis_attribute(const geometry::Ellipsoids& all) {
  Attribute shortest{"shortest half-axis", "model units", {}, true, {}};
  for (const geometry::Vec3 r : all.radii) shortest.values.push_back(std::min({r.x, r.y, r.z}));
  return shortest;
}

}  // namespace ballflow::show
