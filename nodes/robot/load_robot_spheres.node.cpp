#include "robot/load_robot_spheres.hpp"

#include <ballflow/sdk.hpp>

#include "robot/robot_spheres.hpp"
#include "types/artifact_types.hpp"
#include "types/robot_type.hpp"
#include "urdf/sample_robot.hpp"

namespace ballflow::nodes {
namespace {

using geometry::LoadRobotSpheresOptions;

struct LoadRobotSpheres {
  In<geometry::Robot> robot;
  Out<geometry::RobotSpheres> spheres;
  LoadRobotSpheresOptions options;

  static void declare(NodeDecl<LoadRobotSpheres>& d) {
    d.id("LoadRobotSpheres", 1).summary("Reads collision spheres that another program made for a robot.");
    d.doc(
        "cuRobo's collision_spheres (YAML), XRDF, foam, ballpark and other JSON and YAML by link, URDF whose "
        "collisions are spheres, SRDF with link_sphere_approximation, CSV with link, x, y, z and radius, "
        "each also "
        "packed; the content decides. Links that the robot does not have, and spheres of radius 0 and less, "
        "are left out with "
        "a warning; buffers that a file asks for are named, not added. Refuses, with the line, numbers that "
        "are not "
        "finite, and files without a sphere for the robot.");
    d.avoid_when("the balls are for one mesh: LoadBalls.");
    d.cites("sundaralingam2023", "spheres of links");
    d.memory(std::uint64_t{64} << 20, 0);
    d.input("robot", &LoadRobotSpheres::robot).doc("whose links the file names");
    d.output("spheres", &LoadRobotSpheres::spheres)
        .doc("links with the balls of the file; pairs are not looked for");
    d.param("file", &LoadRobotSpheres::options, &LoadRobotSpheresOptions::file)
        .file()
        .scheme(geometry::sample_spheres_scheme)
        .required()
        .doc("the spheres, in the frames of the links, metres; or spheres:arm, some for robot:arm");
    d.param("buffer", &LoadRobotSpheres::options, &LoadRobotSpheresOptions::buffer)
        .unit("m")
        .at_least(0)
        .doc("added to every radius: 0 takes them as they are");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    spheres = geometry::load_robot_spheres(*robot, options, monitor);
  }
};

struct LinkBalls {
  In<geometry::RobotSpheres> spheres;
  Out<geometry::Balls> balls;
  std::string link;

  static void declare(NodeDecl<LinkBalls>& d) {
    d.id("LinkBalls", 1).summary("The balls of one link of a robot, in the frame of the link.");
    d.doc(
        "Its bytes depend on the balls of this link alone. A link without balls gives none. Refuses names "
        "that are no "
        "link.");
    d.avoid_when("the balls come from a file of their own: LoadBalls.");
    d.cites("sundaralingam2023", "spheres of links");
    d.input("spheres", &LinkBalls::spheres).doc("balls of all links");
    d.output("balls", &LinkBalls::balls).doc("n balls, metres");
    d.param("link", &LinkBalls::link).required().doc("name of the link");
  }
  void run(RunContext&) { balls = geometry::balls_of(*spheres, geometry::link_named(*spheres, link)); }
};

}  // namespace

const bf_node* load_robot_spheres_entry() { return node_entry<LoadRobotSpheres>(); }
const bf_node* link_balls_entry() { return node_entry<LinkBalls>(); }

}  // namespace ballflow::nodes
