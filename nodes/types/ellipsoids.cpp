#include "types/ellipsoids.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace ballflow::geometry {

Ellipsoids select(const Ellipsoids& all, std::span<const std::int32_t> ids) {
  std::vector<Vec3> centers, radii;
  std::vector<Quaternion> rotations;
  centers.reserve(ids.size());
  radii.reserve(ids.size());
  rotations.reserve(ids.size());
  for (const std::int32_t id : ids) {
    const auto i = static_cast<std::size_t>(id);
    centers.push_back(all.centers[i]);
    radii.push_back(all.radii[i]);
    rotations.push_back(all.rotations[i]);
  }
  return {std::move(centers), std::move(radii), std::move(rotations)};
}

Box bounding_box(const Ellipsoids& all, std::size_t i) {
  const Frame frame = frame_of(all.rotations[i]);
  const Vec3 r = all.radii[i], c = all.centers[i];
  const auto reach = [&](double x, double y, double z) { return length({r.x * x, r.y * y, r.z * z}); };
  const auto& [a, b, d] = frame.axes;
  const double largest = std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z), r.x, r.y, r.z});
  const double slack = 0x1p-48 * largest;
  const Vec3 half =
      Vec3{reach(a.x, b.x, d.x), reach(a.y, b.y, d.y), reach(a.z, b.z, d.z)} + Vec3{slack, slack, slack};
  return {c - half, c + half};
}

Box bounding_box(const Ellipsoids& all) {
  Box box;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Box one = bounding_box(all, i);
    box.add(one.lower);
    box.add(one.upper);
  }
  return box;
}

double sum_of_volumes(const Ellipsoids& all) {
  double sum = 0;
  for (const Vec3 r : all.radii) sum += 4 * std::numbers::pi / 3 * r.x * r.y * r.z;
  return sum;
}

std::string broken_invariant(const Ellipsoids& all) {
  const std::size_t n = all.size();
  if (all.radii.size() != n || all.rotations.size() != n) {
    return std::to_string(n) + " centers, " + std::to_string(all.radii.size()) + " triples of radii and " +
           std::to_string(all.rotations.size()) + " rotations";
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::string name = "ellipsoid " + std::to_string(i);
    if (!is_finite(all.centers[i])) return "the center of " + name + " is not finite";
    const Vec3 r = all.radii[i];
    if (!is_finite(r) || !(r.x > 0 && r.y > 0 && r.z > 0)) {
      return name + " has the radii " + std::to_string(r.x) + ", " + std::to_string(r.y) + ", " +
             std::to_string(r.z) + ": all have to be above 0";
    }
    const Quaternion q = all.rotations[i];
    const double norm = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    if (!(std::abs(norm - 1) <= 2e-9)) {
      return "the quaternion of " + name + " has the squared length " + std::to_string(norm) +
             " in place of 1";
    }
  }
  return {};
}

}  // namespace ballflow::geometry
