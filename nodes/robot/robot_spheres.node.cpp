#include "robot/robot_spheres.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"
#include "types/enclosure_type.hpp"
#include "types/robot_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::RobotSpheresOptions;
using geometry::SelfCollisionOptions;

struct RobotSpheres {
  In<geometry::Robot> robot;
  InList<geometry::Balls> balls;
  InList<geometry::Enclosure> enclosures;
  Out<geometry::RobotSpheres> spheres;
  RobotSpheresOptions options;

  static void declare(NodeDecl<RobotSpheres>& d) {
    d.id("RobotSpheres", 2)
        .summary("Puts the balls of the links of a robot together, and lists pairs that need no test.");
    d.doc(
        "Pairs of links that need no test against each other: adjacent ones, pairs whose balls meet in the "
        "default "
        "pose, in every pose, or in none. Poses are sampled, not proven: random values between the limits of "
        "the joints, "
        "always the same ones. Refuses names that are no links, and more or fewer lists than links.");
    d.avoid_when("balls belong to no robot: they can be exported as they are.");
    d.cites("coleman2014", "pairs of links by sampled poses");
    d.memory(1 << 20, 4);
    d.input("robot", &RobotSpheres::robot).doc("links and joints");
    d.input("balls", &RobotSpheres::balls).doc("for each link of links, in the frame of the link, metres");
    d.input("enclosures", &RobotSpheres::enclosures)
        .optional()
        .doc(
            "for each link of links, whether its balls contain it: points that they leave out go with the "
            "balls");
    d.output("spheres", &RobotSpheres::spheres)
        .doc("links with balls, joints, pairs, points that are left out");
    d.param("links", &RobotSpheres::options, &RobotSpheresOptions::links)
        .doc(
            "names of the links, separated by commas or a JSON list, in the order of balls; empty: those "
            "with a surface, in that of the robot");
    d.param("poses", &RobotSpheres::options, &RobotSpheresOptions::pairs, &SelfCollisionOptions::poses)
        .unit("poses")
        .at_least(0)
        .at_most(10'000'000)
        .doc("that are tried for pairs of links; 0: none is looked for");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    spheres = geometry::robot_spheres(*robot, {balls.begin(), balls.end()},
                                      {enclosures.begin(), enclosures.end()}, options, monitor);
  }
};

}  // namespace

const bf_node* robot_spheres_entry() { return node_entry<RobotSpheres>(); }

}  // namespace ballflow::nodes
