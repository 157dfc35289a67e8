// Balls of links, together with the robot that they are for.
#pragma once

#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "robot/self_collision.hpp"
#include "types/enclosure.hpp"
#include "types/robot.hpp"
#include "types/robot_spheres.hpp"

namespace ballflow::geometry {

struct RobotSpheresOptions {
  // Names of links, separated by commas or as a list in JSON, in the order of the lists of balls; empty: the
  // links with a surface, in the order of the robot.
  std::string links;
  SelfCollisionOptions pairs;
};

/// Which link each name means. Throws InputError for a name that is no link ("did you mean"), and for one
/// twice.
std::vector<std::size_t> links_named(const RobotTree& tree, const std::vector<std::string>& names);

/// The link of this name. Throws InputError that lists the links when there is none.
std::size_t link_named(const RobotTree& tree, const std::string& name);

/// Names of the links that have triangles, in the order of the robot.
std::vector<std::string> links_with_surface(const Robot& robot);

/// Puts lists of balls, each in the frame of its link, together, with the points that `enclosures` tells of
/// the same links; none of these where nothing was proven. Throws InputError where there are more or fewer
/// lists than links.
RobotSpheres robot_spheres(const Robot& robot, const std::vector<Balls>& balls,
                           const std::vector<Enclosure>& enclosures, const RobotSpheresOptions& options,
                           Monitor& monitor = no_monitor());

/// The same from balls by link, without pairs.
RobotSpheres with_balls(const RobotTree& tree, const std::vector<std::vector<Vec3>>& centers,
                        const std::vector<std::vector<double>>& radii);

}  // namespace ballflow::geometry
