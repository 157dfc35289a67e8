#include "types/balls.hpp"

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

}  // namespace ballflow::geometry
