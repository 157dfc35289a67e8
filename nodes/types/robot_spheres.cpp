#include "types/robot_spheres.hpp"

#include <cmath>

namespace ballflow::geometry {

const char* name_of(PairReason reason) {
  switch (reason) {
    case PairReason::adjacent:
      return "adjacent";
    case PairReason::in_default:
      return "default";
    case PairReason::always:
      return "always";
    case PairReason::never:
      break;
  }
  return "never";
}

Balls balls_of(const RobotSpheres& spheres, std::size_t link) {
  const auto begin = static_cast<std::size_t>(link == 0 ? 0 : spheres.ball_ends[link - 1]);
  const auto size = static_cast<std::size_t>(spheres.ball_ends[link]) - begin;
  Balls balls;
  balls.centers = Array<Vec3>(spheres.centers.data() + begin, size, spheres.centers.owner());
  balls.radii = Array<double>(spheres.radii.data() + begin, size, spheres.radii.owner());
  return balls;
}

std::string broken_invariant(const RobotSpheres& spheres) {
  if (std::string why = broken_invariant(static_cast<const RobotTree&>(spheres)); !why.empty()) return why;
  if (spheres.links() != spheres.joint_kinds.size() + 1) return "not every link has a list of balls";
  std::int64_t before = 0;
  for (std::size_t link = 0; link < spheres.links(); ++link) {
    if (spheres.ball_ends[link] < before) return "the balls of link " + std::to_string(link) + " have no end";
    before = spheres.ball_ends[link];
  }
  if (before != static_cast<std::int64_t>(spheres.radii.size())) return "balls belong to no link";
  for (std::size_t i = 0; i < spheres.radii.size(); ++i) {
    if (!is_finite(spheres.centers[i]) || !std::isfinite(spheres.radii[i]) || spheres.radii[i] < 0)
      return "ball " + std::to_string(i) + " has a centre or radius that is no number, or a negative radius";
  }
  if (spheres.open_ends.empty() ? !spheres.open_points.empty() : spheres.open_ends.size() != spheres.links())
    return "not every link has a list of points that are not covered";
  before = 0;
  for (const std::int64_t end : spheres.open_ends) {
    if (end < before) return "a list of points that are not covered has no end";
    before = end;
  }
  if (before != static_cast<std::int64_t>(spheres.open_points.size()))
    return "points that are not covered belong to no link";
  for (const Vec3& p : spheres.open_points) {
    if (!is_finite(p)) return "a point that is not covered is nowhere";
  }
  for (std::size_t i = 0; i < spheres.pair_links.size(); ++i) {
    const auto [a, b] = spheres.pair_links[i];
    if (a < 0 || b <= a || b >= static_cast<std::int32_t>(spheres.links()) ||
        (i > 0 && !(spheres.pair_links[i - 1] < spheres.pair_links[i])) ||
        spheres.pair_reasons[i] > static_cast<std::uint8_t>(PairReason::never))
      return "pair " + std::to_string(i) + " is none";
  }
  return {};
}

}  // namespace ballflow::geometry
