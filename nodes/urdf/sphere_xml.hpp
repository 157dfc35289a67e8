// Spheres of links in XML: URDF whose collisions are spheres, and MoveIt's SRDF.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "types/robot_spheres.hpp"

namespace ballflow::geometry {

struct LinkSpheres {
  std::string link;  // empty: the file names none
  std::vector<Vec3> centers;
  std::vector<double> radii;
};

/// The spheres among the collisions of a URDF, or the <link_sphere_approximation> of an SRDF, link by link in
/// the order of the file. `warnings` says what collisions are no spheres. Throws InputError for other XML,
/// and for numbers that are none, not finite, or negative.
std::vector<LinkSpheres> spheres_in_xml(std::string_view text, const std::string& file,
                                        std::vector<std::string>& warnings);

/// The description of the robot with its collisions replaced by its balls, everything else as it was; links
/// without balls have no collision.
std::string urdf_with_spheres(const RobotSpheres& spheres);

/// The shortest decimal text that reads back as the same number.
std::string shortest_text(double value);
/// Text for an attribute or element of XML.
std::string xml_text(std::string_view text);

}  // namespace ballflow::geometry
