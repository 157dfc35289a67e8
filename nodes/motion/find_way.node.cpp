#include "motion/find_way.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/motion_types.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::FindWayOptions;

struct FindWay {
  In<geometry::Balls> balls;
  In<geometry::PowerDiagram> diagram;
  In<geometry::MinkowskiReport> report;
  Out<geometry::Way> way;
  FindWayOptions options;

  static void declare(NodeDecl<FindWay>& d) {
    d.id("FindWay", 2).summary("Whether there is a way between two points around a union of balls, and one.");
    d.doc(
        "Start and goal can be joined outside of the balls if they are in one component of what the union "
        "leaves of "
        "space; the power diagram has the components, and predicates decide exactly where both are. Where "
        "there is a "
        "way, one goes along edges of the diagram that are outside of the union, short, with corners cut off "
        "where "
        "that keeps its clearance; every segment is checked exactly. A start or goal in a ball or on its "
        "sphere is "
        "named, with the ball. With the report of the sum that the balls are the result says what is proven "
        "about "
        "the solids: of balls that contain the forbidden places a way, of balls that lie in them that there "
        "is none. "
        "Accepts any balls and points. Refuses empty sets, and coordinates beyond 1e140.");
    d.avoid_when("the robot turns on its way, or the shortest or safest way is asked for: planners do that.");
    d.cites("kornberger2010", "5.1")
        .cites("edelsbrunner1995", "components of the complement by the dual complex")
        .cites("lozano1983", "obstacles in the space of configurations");
    d.library("CGAL", geometry::cgal_version());
    d.memory(64 << 20, 30);
    d.input("balls", &FindWay::balls).doc("n balls: where what moves must not be, model units");
    d.input("diagram", &FindWay::diagram).doc("their power diagram, with tolerance none");
    d.input("report", &FindWay::report)
        .optional()
        .doc("of the Minkowski sum that the balls are: what it proves about the solids");
    d.output("way", &FindWay::way).doc("the answer, components, and a polyline where there is a way");
    d.param("start", &FindWay::options, &FindWayOptions::start)
        .doc("where the way begins: \"x y z\", model units");
    d.param("goal", &FindWay::options, &FindWayOptions::goal).doc("where it ends: \"x y z\", model units");
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    way =
        geometry::find_way(*balls, *diagram, geometry::parse_point(options.start, "start"),
                           geometry::parse_point(options.goal, "goal"), monitor, report ? &*report : nullptr);
  }
};

}  // namespace

const bf_node* find_way_entry() { return node_entry<FindWay>(); }

}  // namespace ballflow::nodes
