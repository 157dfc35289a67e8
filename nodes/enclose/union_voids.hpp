// The voids of a union of balls, and which of them matter to what is inside a surface.
#pragma once

#include <vector>

#include "base/monitor.hpp"
#include "search/winding_number.hpp"
#include "types/enclosure.hpp"
#include "types/power_diagram.hpp"

namespace ballflow::geometry {

/// A part of space that balls leave out and close off from infinity.
struct UnionVoid {
  Vec3 deepest;  // where the balls are farthest away, by their powers; rounded
  VoidPlace place = VoidPlace::unknown;

  bool matters() const { return place != VoidPlace::outside; }
};

/// All of them (power/voids.hpp), and on which side of the surface of `winding` they lie.
std::vector<UnionVoid> union_voids(const PowerDiagram& diagram, const WindingNumber& winding,
                                   Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
