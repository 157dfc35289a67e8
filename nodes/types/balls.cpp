#include "types/balls.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace ballflow::geometry {

Balls select(const Balls& balls, std::span<const std::int32_t> ids) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  std::vector<std::int64_t> offsets;
  std::vector<std::int32_t> samples;
  centers.reserve(ids.size());
  radii.reserve(ids.size());
  const bool defined = !balls.defining_offsets.empty();
  if (defined) offsets.push_back(0);
  for (const std::int32_t id : ids) {
    const auto i = static_cast<std::size_t>(id);
    centers.push_back(balls.centers[i]);
    radii.push_back(balls.radii[i]);
    if (!defined) continue;
    for (const std::int32_t s : balls.samples_of(i)) samples.push_back(s);
    offsets.push_back(static_cast<std::int64_t>(samples.size()));
  }
  return {std::move(centers), std::move(radii), std::move(offsets), std::move(samples)};
}

Box bounding_box(const Balls& balls) {
  Box box;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 r{balls.radii[i], balls.radii[i], balls.radii[i]};
    box.add(balls.centers[i] - r);
    box.add(balls.centers[i] + r);
  }
  return box;
}

std::string broken_invariant(const Balls& balls) {
  const std::size_t n = balls.size();
  if (balls.centers.size() != n) {
    return std::to_string(balls.centers.size()) + " centers but " + std::to_string(n) + " radii";
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_finite(balls.centers[i])) return "the center of ball " + std::to_string(i) + " is not finite";
    if (!std::isfinite(balls.radii[i]) || balls.radii[i] < 0) {
      return "ball " + std::to_string(i) + " has radius " + std::to_string(balls.radii[i]);
    }
  }
  if (balls.defining_offsets.empty()) {
    if (balls.defining_samples.empty()) return {};
    return std::to_string(balls.defining_samples.size()) + " defining samples but no offsets";
  }
  if (balls.defining_offsets.size() != n + 1) {
    return std::to_string(n) + " balls but " + std::to_string(balls.defining_offsets.size()) +
           " offsets of defining samples, there must be one more than balls or none";
  }
  const auto total = static_cast<std::int64_t>(balls.defining_samples.size());
  if (balls.defining_offsets[0] != 0 || balls.defining_offsets.back() != total) {
    return "offsets of defining samples run from " + std::to_string(balls.defining_offsets[0]) + " to " +
           std::to_string(balls.defining_offsets.back()) + ", there are " + std::to_string(total) +
           " samples";
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (balls.defining_offsets[i] > balls.defining_offsets[i + 1]) {
      return "the defining samples of ball " + std::to_string(i) + " end before they begin";
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::int32_t last = -1;
    for (const std::int32_t s : balls.samples_of(i)) {
      if (s <= last) {
        return "the defining samples of ball " + std::to_string(i) + " do not ascend at " + std::to_string(s);
      }
      last = s;
    }
  }
  return {};
}

}  // namespace ballflow::geometry
