#include "robot/read_robot.hpp"

#include <ballflow/sdk.hpp>

#include "robot/read_dae.hpp"
#include "types/artifact_types.hpp"
#include "types/robot_type.hpp"
#include "urdf/sample_robot.hpp"

namespace ballflow::nodes {
namespace {

using geometry::ReadRobotOptions;
using geometry::RobotGeometry;

struct ReadRobot {
  Out<geometry::Robot> robot;
  ReadRobotOptions options;

  static void declare(NodeDecl<ReadRobot>& d) {
    d.id("ReadRobot", 1).summary("Reads a robot from its URDF: links with their surfaces, and joints.");
    d.doc(
        "Links, joints with origins, axes, limits and mimics, and the collision or visual shapes of every "
        "link in "
        "its frame, in metres: meshes (STL, OBJ, PLY, OFF, also packed, and Collada with its unit, whose up "
        "axis is "
        "not applied), with scale and origin, boxes, cylinders and spheres, several for a link. All "
        "triangles are "
        "kept. Cylinders and spheres become polyhedra around them, which stand out by at most 0.4 % of the "
        "radius, so "
        "that what contains the polyhedron contains the shape. Meshes are looked for where package://, "
        "file:// and "
        "relative paths say, then by their names below the folder of the URDF and below packages, with a "
        "warning; "
        "their contents are in the key. Refuses, with the line, what is no tree of links, names twice, "
        "unknown "
        "shapes, a scale of 0, numbers that are not finite, meshes that are nowhere, SDF, MJCF, and xacro "
        "with the "
        "command that expands it.");
    d.avoid_when("one mesh is all there is: Sample reads that.");
    d.cites("quigley2015", "the format, chapter 4");
    d.library("assimp", geometry::dae_library_version());
    d.memory(std::uint64_t{256} << 20, 0);
    d.reads_named_files<&ReadRobot::named>();
    d.output("robot", &ReadRobot::robot).doc("links with their surfaces in metres, and joints");
    d.param("file", &ReadRobot::options, &ReadRobotOptions::file)
        .file()
        .scheme(geometry::sample_robot_scheme)
        .required()
        .doc("a URDF, also packed; or robot:arm, a small robot of boxes, cylinders and spheres");
    d.choice("geometry", &ReadRobot::options, &ReadRobotOptions::geometry,
             {{RobotGeometry::collision, "collision", "the shapes that are meant for collisions"},
              {RobotGeometry::visual, "visual", "the shapes that are meant to be seen"}})
        .doc("which shapes of the links are taken");
    d.param("packages", &ReadRobot::options, &ReadRobotOptions::packages)
        .not_hashed()
        .doc(
            "folders, separated by colons, in which ROS packages or meshes are; contents of meshes are in "
            "the key, "
            "places are not");
  }
  std::vector<NamedFile> named() const {
    std::vector<NamedFile> files;
    for (const auto& [name, path] : geometry::mesh_files_of(options)) files.push_back({name, path});
    return files;
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    robot = geometry::read_robot(options, monitor);
  }
};

}  // namespace

const bf_node* read_robot_entry() { return node_entry<ReadRobot>(); }

}  // namespace ballflow::nodes
