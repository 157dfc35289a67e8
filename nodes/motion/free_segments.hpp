// Whether segments meet balls.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "motion/ball_boxes.hpp"

namespace ballflow::geometry {

/// Questions about segments among balls.
class FreeSegments {
 public:
  /// Keeps a reference.
  explicit FreeSegments(const BallBoxes& balls) : balls_(balls) {}

  /// The distance from the segment to the next ball, negative inside; rounded. Below `enough` it may be any
  /// value below `enough`.
  double clearance(Vec3 from, Vec3 to, double enough = -1e300) const;
  /// No point of the segment is in a ball or on its sphere; as if decided with real numbers.
  bool free(Vec3 from, Vec3 to) const;
  /// The ball, by its index, that a point is in or on, the deepest as rounding sees it; -1: none, decided
  /// exactly.
  std::int32_t ball_at(Vec3 point) const;

 private:
  const BallBoxes& balls_;
};

}  // namespace ballflow::geometry
