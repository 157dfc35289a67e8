#include "enclose/bounded_balls.hpp"

#include <ballflow/sdk.hpp>

#include "enclose/allocate_balls.hpp"
#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/enclosure_fit_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::BallGoal;
using geometry::BoundedBallsOptions;

/// What both nodes have.
template <class Node>
void declare_ports(NodeDecl<Node>& d) {
  d.library("CGAL", geometry::cgal_version());
  d.memory(64 << 20, 100);
  d.input("mesh", &Node::mesh).doc("a closed mesh, model units; orientation does not matter");
  d.input("count", &Node::count)
      .optional()
      .doc("how many balls, in place of the parameter: one count, of AllocateBalls");
  d.output("balls", &Node::balls).doc("at most as many balls as wanted");
  d.output("fit", &Node::fit).doc("how many they are, and about how much they leave uncovered");
  d.param("balls", &Node::options, &BoundedBallsOptions::balls)
      .unit("balls")
      .at_least(1)
      .at_most(5000)
      .doc("no more balls than this");
  d.param("rounds", &Node::options, &BoundedBallsOptions::rounds)
      .unit("rounds")
      .at_least(0)
      .at_most(1000)
      .doc("of the local search: each moves or exchanges every ball once; it ends when nothing changes");
  d.param("seed", &Node::options, &BoundedBallsOptions::seed)
      .unit("number")
      .at_least(0)
      .doc("other seeds find other balls that cover about as much");
}

template <class Node>
void search(Node& node, RunContext& context, BoundedBallsOptions wanted) {
  ContextMonitor monitor(context);
  if (node.count) wanted.balls = geometry::only_count(*node.count);
  geometry::BoundedBalls found = geometry::bounded_balls(*node.mesh, wanted, monitor);
  monitor.note(geometry::describe(found.fit));
  node.balls = std::move(found.balls);
  node.fit = found.fit;
}

struct InsideBalls {
  In<geometry::TriangleMesh> mesh;
  In<geometry::BallCounts> count;
  Out<geometry::Balls> balls;
  Out<geometry::EnclosureFit> fit;
  BoundedBallsOptions options;

  static void declare(NodeDecl<InsideBalls>& d) {
    d.id("InsideBalls", 1)
        .summary("A given number of balls inside a solid that cover as much of it as they can.");
    d.doc(
        "No point of a ball is outside: its centre is inside, and its radius at most the distance to the "
        "surface. Centres are those of "
        "largest inner balls, chosen greedily, then moved and exchanged while that covers more. For "
        "distances that must not be too "
        "large, or balls to be grasped or filled. Refuses meshes that are not closed.");
    d.avoid_when("nothing of the solid may be outside of the balls: EncloseBalls.");
    declare_ports(d);
  }
  void run(RunContext& context) {
    BoundedBallsOptions wanted = options;
    wanted.within = 0;
    search(*this, context, wanted);
  }
};

enum class Unit { percent, model };

struct ProtrudeBalls {
  In<geometry::TriangleMesh> mesh;
  In<geometry::BallCounts> count;
  Out<geometry::Balls> balls;
  Out<geometry::EnclosureFit> fit;
  BoundedBallsOptions options{.goal = BallGoal::surface};
  double within = 1;
  Unit unit = Unit::percent;

  static void declare(NodeDecl<ProtrudeBalls>& d) {
    d.id("ProtrudeBalls", 1)
        .summary(
            "A given number of balls that stand out of a solid by no more than a distance, and cover as much "
            "as they can.");
    d.doc(
        "No point of a ball is farther than the distance from the solid: its centre is inside, and its "
        "radius the distance to the surface "
        "and that one. Chosen and moved as by InsideBalls. Refuses meshes that are not closed.");
    d.avoid_when("nothing of the solid may be outside of the balls: EncloseBalls.");
    declare_ports(d);
    d.param("within", &ProtrudeBalls::within).unit("see unit").at_least(0).doc("how far balls may stand out");
    d.choice("unit", &ProtrudeBalls::unit,
             {{Unit::percent, "percent", "% of the longest bounding-box edge"},
              {Unit::model, "model", "model units"}})
        .doc("what within is measured in");
    d.choice("goal", &ProtrudeBalls::options, &BoundedBallsOptions::goal,
             {{BallGoal::surface, "surface", "little of the surface is in no ball"},
              {BallGoal::volume, "volume", "little of the volume is in no ball"}})
        .doc("what they are to cover");
  }
  void run(RunContext& context) {
    BoundedBallsOptions wanted = options;
    const double edge = geometry::bounding_box(mesh->vertices.span()).longest_edge();
    wanted.within = unit == Unit::model ? within : within / 100 * (mesh->vertices.empty() ? 0 : edge);
    search(*this, context, wanted);
  }
};

}  // namespace

const bf_node* inside_balls_entry() { return node_entry<InsideBalls>(); }
const bf_node* protrude_balls_entry() { return node_entry<ProtrudeBalls>(); }

}  // namespace ballflow::nodes
