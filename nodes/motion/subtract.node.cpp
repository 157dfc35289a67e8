#include "motion/subtract.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

struct Subtract {
  In<geometry::Balls> a, b;
  Out<geometry::Balls> balls;

  static void declare(NodeDecl<Subtract>& d) {
    d.id("Subtract", 1).summary("Balls less other balls: radii so small that none reaches into the others.");
    d.doc(
        "Every radius of a becomes the distance of its center from the union of b, rounded downwards, where "
        "that is "
        "less; centers in a ball of b go. The union of the result lies in that of a, and has no point inside "
        "a ball "
        "of b. With balls of a inside a workpiece, and balls of b that contain what a tool sweeps, it is "
        "material "
        "that surely stays. It is no more than what balls around the centers of a can hold: more centers "
        "hold more. "
        "Accepts any balls, also none. Refuses coordinates and radii beyond 1e140.");
    d.avoid_when("all of the difference is wanted as a surface: Boolean operations on meshes give that.");
    d.cites("kornberger2010", "5.2").cites("quinlan1994", "distances by trees of balls, branch and bound");
    d.memory(32 << 20, 8);
    d.input("a", &Subtract::a).doc("balls to be made smaller, many of them, model units");
    d.input("b", &Subtract::b).doc("balls that they must not reach into, in the same place and unit");
    d.output("balls", &Subtract::balls).doc("the balls of a that are left, in their order");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    balls = geometry::subtracted(*a, *b, monitor);
  }
};

}  // namespace

const bf_node* subtract_entry() { return node_entry<Subtract>(); }

}  // namespace ballflow::nodes
