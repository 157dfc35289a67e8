// Points in an order in which those that follow each other are close.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// The place of points on a Z-shaped curve through a box, 20 bits per coordinate (Morton 1966).
class SpaceOrder {
 public:
  explicit SpaceOrder(const Box& box) : lower_(box.lower) {
    if (box.longest_edge() > 0) scale_ = 0x1p20 / box.longest_edge();
  }
  std::uint64_t operator()(Vec3 p) const {
    const Vec3 q = scale_ * (p - lower_);
    return spread(q.x) << 2 | spread(q.y) << 1 | spread(q.z);
  }

 private:
  /// Bit k goes to bit 3 k.
  static std::uint64_t spread(double coordinate) {
    auto bits = static_cast<std::uint64_t>(std::clamp(coordinate, 0.0, 0x1p20 - 1));
    bits = (bits | bits << 32) & 0x001f00000000ffffu;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    bits = (bits | bits << 2) & 0x1249249249249249u;
    return bits;
  }

  Vec3 lower_;
  double scale_ = 0;
};

}  // namespace ballflow::geometry
