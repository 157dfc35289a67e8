// The text of a URDF as plain data: nothing is read that it names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "types/robot.hpp"

namespace ballflow::geometry {

struct UrdfShape {
  enum class Kind { mesh, box, cylinder, sphere };
  Kind kind = Kind::mesh;
  std::string file;        // of a mesh, as it is written
  Vec3 scale = {1, 1, 1};  // of a mesh; none is 0
  Vec3 size;  // box: the three edges; cylinder: radius, length; sphere: radius. Metres, at least 0
  Pose origin = no_motion;
  int line = 0;
};

struct UrdfLink {
  std::string name;
  std::vector<UrdfShape> collisions, visuals;
  int line = 0;
};

struct UrdfJoint {
  std::string name, parent, child, mimics;  // the last one empty: no other joint
  JointKind kind = JointKind::fixed;
  Pose origin = no_motion;
  Vec3 axis = {1, 0, 0};
  double lower = 0, upper = 0, mimic_factor = 1, mimic_offset = 0;
  int line = 0;
};

struct Urdf {
  std::string name;
  std::vector<UrdfLink> links;    // names differ
  std::vector<UrdfJoint> joints;  // names differ; parents and children are links; a tree
  std::vector<std::string> warnings;
};

/// Reads a URDF. `file` is what messages call it.
///
/// - Lengths are metres and angles radians, as URDF has them. Numbers are read with the decimal point in
/// every
///   locale.
/// - Throws InputError, naming the line and the element, for text that is no XML or no URDF (SDF, MJCF and
/// xacro
///   by their names, xacro with the command that expands it); for links or joints without a name or with one
///   twice, or with names of several lines; joints without parent or child, or with ones that are no links; a
/// link with two parents, several
///   roots, a circle; unknown joint types and shapes, missing or negative sizes, a scale of 0, numbers that
///   are
/// none or
///   not finite, an axis of length 0.
/// - Warns about revolute and prismatic joints without limits.
Urdf parse_urdf(std::string_view text, const std::string& file);

/// Names of the links that have shapes with a volume, in the order of the file.
std::vector<std::string> links_with_shapes(const Urdf& urdf, bool visual);

}  // namespace ballflow::geometry
