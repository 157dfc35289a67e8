#include <ballflow/sdk.hpp>

#include "robot/robot_spheres.hpp"
#include "types/artifact_types.hpp"
#include "types/robot_type.hpp"

namespace ballflow::nodes {
namespace {

struct RobotLink {
  In<geometry::Robot> robot;
  Out<geometry::TriangleMesh> mesh;
  std::string link;

  static void declare(NodeDecl<RobotLink>& d) {
    d.id("RobotLink", 1).summary("The surface of one link of a robot, in the frame of the link.");
    d.doc(
        "Its bytes depend on the shapes of this link alone: where another link or a joint changes, what is "
        "made of this mesh stays in the cache. Refuses names that are no link, and links without a surface.");
    d.avoid_when("the robot is a single mesh file: Sample.");
    d.cites("quigley2015", "links");
    d.input("robot", &RobotLink::robot).doc("links with their surfaces");
    d.output("mesh", &RobotLink::mesh).doc("m triangles in the frame of the link, metres");
    d.param("link", &RobotLink::link).required().doc("name of the link");
  }
  void run(RunContext&) {
    geometry::TriangleMesh found = geometry::mesh_of(*robot, geometry::link_named(*robot, link));
    if (found.triangles.empty()) {
      std::string with;
      for (const std::string& name : geometry::links_with_surface(*robot))
        with += (with.empty() ? "" : ", ") + name;
      throw NodeError("link \"" + link + "\" has no surface",
                      with.empty()
                          ? "no link has one: geometry visual takes the shapes that are meant to be seen"
                          : "links with a surface are " + with);
    }
    mesh = std::move(found);
  }
};

}  // namespace

const bf_node* robot_link_entry() { return node_entry<RobotLink>(); }

}  // namespace ballflow::nodes
