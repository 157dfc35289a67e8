// A bounding box as a field of a summary.
#pragma once

#include <array>
#include <ballflow/sdk/summary.hpp>

#include "base/vec3.hpp"

namespace ballflow {

/// [[min x, y, z], [max x, y, z]], model units; null where the box is empty.
inline SummaryValue box_summary(const geometry::Box& box) {
  if (box.empty()) return nullptr;
  return std::array<std::array<double, 3>, 2>{
      {{box.lower.x, box.lower.y, box.lower.z}, {box.upper.x, box.upper.y, box.upper.z}}};
}

}  // namespace ballflow
