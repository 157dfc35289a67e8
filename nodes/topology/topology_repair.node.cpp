#include "topology/topology_repair.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::RepairMethod;
using geometry::TopologyRepairOptions;

struct TopologyRepair {
  In<geometry::CoverState> cover;
  In<geometry::Balls> balls;
  In<geometry::PowerDiagram> diagram;
  Out<geometry::CoverState> repaired;
  Out<geometry::TopologyCheck> check;
  TopologyRepairOptions options;

  static void declare(NodeDecl<TopologyRepair>& d) {
    d.id("TopologyRepair", 2).summary("Return balls whose absence changed the topology of the union.");
    d.doc(
        "Compares the union of the chosen balls with that of all balls, component by component, loop by loop "
        "and cavity by cavity, and returns balls until the inclusion induces isomorphisms of homology over "
        "Z/2. That is checked in the end, whatever the method did, with exact decisions for the balls as "
        "they "
        "are. Nothing is returned where nothing is wrong; in the worst case everything is, and the check "
        "says so. "
        "Where more than most_defects is wrong, only components are joined, and a warning says so. Refuses a "
        "cover about another number of balls.");
    d.avoid_when(
        "the balls were not enlarged: where polar balls of one sample touch, rounding decides what their "
        "union "
        "looks like.");
    d.cites("kornberger2010", "3.6.5, Listing 3.2");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 64);
    d.input("cover", &TopologyRepair::cover).doc("a finished cover");
    d.input("balls", &TopologyRepair::balls)
        .doc("the balls the covering matrix was made of, row i is ball i");
    d.input("diagram", &TopologyRepair::diagram)
        .optional()
        .doc("their power diagram, with tolerance none: they are not triangulated again");
    d.output("cover", &TopologyRepair::repaired).doc("the cover, and the balls that were returned");
    d.output("check", &TopologyRepair::check)
        .doc("what the inclusion does to homology before and after, and what the repair cost");
    d.choice("method", &TopologyRepair::options, &TopologyRepairOptions::method,
             {{RepairMethod::localised, "localised",
               "few balls: shortest paths for what is apart or lost, balls around the place for what is not "
               "filled"},
              {RepairMethod::literal, "literal",
               "the algorithm of the thesis, one alpha-shape per ball; for at most 2000 balls"}})
        .doc("how balls to be returned are found");
    d.param("most_defects", &TopologyRepair::options, &TopologyRepairOptions::most_defects)
        .unit("components, tunnels and cavities")
        .at_least(0)
        .doc(
            "where more of them are lost or extra only components are joined, and a warning says so: the "
            "surface "
            "crosses itself, or the sample is far too coarse, and minutes would go by; a hundred defects "
            "cost seconds");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    const geometry::TopologyRepair repair =
        geometry::repair_topology(*balls, *cover, options, monitor, diagram ? &*diagram : nullptr);
    repaired = geometry::with_returned(*cover, repair.returned);
    repaired.summary("returned", repair.check.returned);
    check = repair.check;
  }
};

}  // namespace

const bf_node* topology_repair_entry() { return node_entry<TopologyRepair>(); }

}  // namespace ballflow::nodes
