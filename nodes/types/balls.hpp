// A set of closed balls.
#pragma once

#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

struct Balls {
  Array<Vec3> centers;  // n x 3, model units; finite
  Array<double> radii;  // n, model units, >= 0; weights of power diagrams are radii^2 (thesis, 2.4)

  // The samples that define each ball: a polar ball passes through them, so it covers them whatever
  // rounding says. Ball i is defined by defining_samples[defining_offsets[i] .. defining_offsets[i + 1]),
  // ascending indices into the PointSet it was made from. Both arrays are empty for balls of other origin.
  Array<std::int64_t> defining_offsets;  // n + 1, or empty
  Array<std::int32_t> defining_samples;

  std::size_t size() const { return radii.size(); }
  std::span<const std::int32_t> samples_of(std::size_t ball) const {
    if (defining_offsets.empty()) return {};
    const auto first = static_cast<std::size_t>(defining_offsets[ball]);
    const auto last = static_cast<std::size_t>(defining_offsets[ball + 1]);
    return defining_samples.span().subspan(first, last - first);
  }
};

/// Balls `ids` of `balls`, in that order, with their defining samples.
Balls select(const Balls& balls, std::span<const std::int32_t> ids);

/// Bounding box of the union.
Box bounding_box(const Balls& balls);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const Balls& balls);

}  // namespace ballflow::geometry
