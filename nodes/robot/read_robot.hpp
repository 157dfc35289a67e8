// A robot from its URDF and the meshes that it names.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "types/robot.hpp"

namespace ballflow::geometry {

enum class RobotGeometry { collision, visual };

struct ReadRobotOptions {
  std::string file;      // a URDF, also packed; or robot:arm, a small robot of boxes, cylinders and balls
  std::string packages;  // folders, separated by colons
  RobotGeometry geometry = RobotGeometry::collision;
};

/// Reads a robot (see parse_urdf for what it refuses) and the surfaces of its links, in the frame of each
/// link and in metres.
///
/// - Meshes: everything that read_mesh_file reads, and Collada (.dae, see read_dae). All their triangles are
/// taken as
///   they are, only those with a repeated corner are left out; equal vertices are one. find_mesh says where
/// meshes are
///   looked for; one that is not where its name says is taken with a warning.
/// - Boxes exactly; cylinders and spheres as polyhedra around them, which stand out by at most `roundness` of
/// the radius
///   (0.4 %), so that what contains the polyhedron contains the shape. Shapes of size 0 are left out with a
///   warning.
/// - Links without such shapes have an empty surface.
///
/// Throws InputError, naming URDF, line, link and file, for a mesh that is nowhere, cannot be read, has no
/// triangle or coordinates that are not finite after scale and origin.
Robot read_robot(const ReadRobotOptions& options, Monitor& monitor = no_monitor());

/// The mesh files that read_robot reads: the name that the URDF has, and where it is, empty for nowhere. None
/// where the URDF cannot be read.
std::vector<std::pair<std::string, std::string>> mesh_files_of(const ReadRobotOptions& options);

}  // namespace ballflow::geometry
