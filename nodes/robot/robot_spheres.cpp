#include "robot/robot_spheres.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "robot/load_robot_spheres.hpp"

namespace ballflow::geometry {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 30; ++i) text += (i == 0 ? "" : ", ") + names[i];
  return names.size() > 30 ? text + " and " + std::to_string(names.size() - 30) + " more" : text;
}

/// Points of the surface and of voids inside that are in no ball.
std::vector<Vec3> open_points(const Enclosure& enclosure) {
  std::vector<Vec3> points(enclosure.open_points.begin(), enclosure.open_points.end());
  for (std::size_t i = 0; i < enclosure.void_points.size(); ++i) {
    if (enclosure.void_places[i] != static_cast<std::uint8_t>(VoidPlace::outside))
      points.push_back(enclosure.void_points[i]);
  }
  return points;
}

void add_open_points(RobotSpheres& spheres, const std::vector<std::size_t>& links,
                     const std::vector<Enclosure>& enclosures) {
  std::vector<std::vector<Vec3>> by_link(spheres.links());
  for (std::size_t i = 0; i < links.size(); ++i) by_link[links[i]] = open_points(enclosures[i]);
  std::vector<std::int64_t> ends;
  std::vector<Vec3> all;
  for (const std::vector<Vec3>& points : by_link) {
    all.insert(all.end(), points.begin(), points.end());
    ends.push_back(static_cast<std::int64_t>(all.size()));
  }
  spheres.open_ends = std::move(ends);
  spheres.open_points = std::move(all);
}

}  // namespace

std::size_t link_named(const RobotTree& tree, const std::string& name) {
  const std::vector<std::string> known = names_of(tree.link_names);
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end())
    throw InputError("the robot \"" + std::string(view(tree.name)) + "\" has no link \"" + name + "\"",
                     "its links are " + listed(known));
  return static_cast<std::size_t>(found - known.begin());
}

std::vector<std::size_t> links_named(const RobotTree& tree, const std::vector<std::string>& names) {
  std::vector<std::size_t> links;
  std::set<std::string> seen;
  for (const std::string& name : names) {
    links.push_back(link_named(tree, name));
    if (!seen.insert(name).second)
      throw InputError("link \"" + name + "\" is named twice", "each list of balls is for one link");
  }
  return links;
}

std::vector<std::string> links_with_surface(const Robot& robot) {
  std::vector<std::string> names = names_of(robot.link_names), found;
  for (std::size_t i = 0; i < robot.links(); ++i) {
    if (!mesh_of(robot, i).triangles.empty()) found.push_back(names[i]);
  }
  return found;
}

RobotSpheres with_balls(const RobotTree& tree, const std::vector<std::vector<Vec3>>& centers,
                        const std::vector<std::vector<double>>& radii) {
  RobotSpheres result;
  static_cast<RobotTree&>(result) = tree;
  std::vector<std::int64_t> ends;
  std::vector<Vec3> all_centers;
  std::vector<double> all_radii;
  for (std::size_t link = 0; link < centers.size(); ++link) {
    all_centers.insert(all_centers.end(), centers[link].begin(), centers[link].end());
    all_radii.insert(all_radii.end(), radii[link].begin(), radii[link].end());
    ends.push_back(static_cast<std::int64_t>(all_radii.size()));
  }
  result.ball_ends = std::move(ends);
  result.centers = std::move(all_centers);
  result.radii = std::move(all_radii);
  return result;
}

RobotSpheres robot_spheres(const Robot& robot, const std::vector<Balls>& balls,
                           const std::vector<Enclosure>& enclosures, const RobotSpheresOptions& options,
                           Monitor& monitor) {
  const std::vector<std::string> names =
      options.links.empty() ? links_with_surface(robot) : names_in(options.links);
  if (names.size() != balls.size())
    throw InputError(std::to_string(balls.size()) + " lists of balls are connected for " +
                         std::to_string(names.size()) + " links: " + listed(names),
                     "connect one for each link, in this order, or name the links: links");
  if (!enclosures.empty() && enclosures.size() != balls.size())
    throw InputError(std::to_string(enclosures.size()) + " verdicts are connected for " +
                         std::to_string(balls.size()) + " lists of balls",
                     "connect one for each list of balls, in the same order, or none");
  const std::vector<std::size_t> links = links_named(robot, names);
  std::vector<std::vector<Vec3>> centers(robot.links());
  std::vector<std::vector<double>> radii(robot.links());
  for (std::size_t i = 0; i < links.size(); ++i) {
    centers[links[i]].assign(balls[i].centers.begin(), balls[i].centers.end());
    radii[links[i]].assign(balls[i].radii.begin(), balls[i].radii.end());
  }
  RobotSpheres result = with_balls(robot, centers, radii);
  if (!enclosures.empty()) add_open_points(result, links, enclosures);
  UntestedPairs pairs = untested_pairs(result, options.pairs, monitor);
  result.pair_links = std::move(pairs.links);
  result.pair_reasons = std::move(pairs.reasons);
  result.poses = options.pairs.poses;
  return result;
}

}  // namespace ballflow::geometry
