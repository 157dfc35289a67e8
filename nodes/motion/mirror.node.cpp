#include "motion/mirror.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

struct Mirror {
  In<geometry::Balls> balls;
  Out<geometry::Balls> mirrored;

  static void declare(NodeDecl<Mirror>& d) {
    d.id("Mirror", 1).summary("Balls mirrored at the origin: every center c becomes -c.");
    d.doc(
        "Minkowski sums with mirrored balls tell where something meets something else: p lies in obstacles + "
        "(-robot) exactly where the robot, moved by p, meets the obstacles. The origin is that of the "
        "coordinates, whatever the balls are: it is the point of the robot whose places the sum is about. "
        "Exact; "
        "radii and order stay. Accepts any balls, also none.");
    d.avoid_when("the robot is symmetric about its origin: it is its own mirror image.");
    d.cites("kornberger2010", "5.1").cites("lozano1983", "obstacles in the space of configurations");
    d.memory(1 << 20, 2);
    d.input("balls", &Mirror::balls).doc("balls, model units; the origin is what they are placed by");
    d.output("balls", &Mirror::mirrored).doc("the balls (-c, r), in the same order");
  }
  void run(RunContext&) { mirrored = geometry::mirrored(*balls); }
};

}  // namespace

const bf_node* mirror_entry() { return node_entry<Mirror>(); }

}  // namespace ballflow::nodes
