// Spheres for the links of a robot, from other programs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.hpp"
#include "types/robot.hpp"
#include "types/robot_spheres.hpp"
#include "urdf/sphere_xml.hpp"

namespace ballflow::geometry {

struct LoadRobotSpheresOptions {
  std::string file;
  double buffer = 0;  // added to every radius, metres
};

/// Spheres as programs write them; the content decides:
/// - YAML and JSON: collision_spheres of cuRobo (in robot_cfg.kinematics, in kinematics, or alone), geometry
/// of XRDF,
///   lists of foam (one link, not named), ballpark ({link: {centers, radii}}), lists of spheres that each
///   name their link, and {link: [{center, radius}]};
/// - URDF whose collisions are spheres, and SRDF with link_sphere_approximation;
/// - CSV with the columns link, x, y, z and r or radius.
///
/// Radii of 0 and less, which say that a link has no sphere, are left out. Throws InputError, naming file and
/// link or line, for content that is none of these, and for numbers that are none or not finite.
std::vector<LinkSpheres> parse_link_spheres(std::string_view content, const std::string& file,
                                            std::vector<std::string>& warnings);

/// Entries of "a,b", or of a list in JSON.
std::vector<std::string> names_in(const std::string& text);

/// The spheres of a file for this robot. Links that the robot does not have are left out with a warning; none
/// left is an InputError. A list without the name of a link is for the only link with a surface, or for the
/// link that the file is named like.
RobotSpheres load_robot_spheres(const Robot& robot, const LoadRobotSpheresOptions& options,
                                Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
