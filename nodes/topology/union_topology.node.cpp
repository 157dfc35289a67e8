#include "topology/union_topology.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::TopologyStage;
using geometry::UnionTopologyOptions;

struct UnionTopology {
  In<geometry::Balls> balls;
  In<geometry::PowerDiagram> diagram;
  Out<geometry::TopologyTable> topology;
  UnionTopologyOptions options;

  static void declare(NodeDecl<UnionTopology>& d) {
    d.id("UnionTopology", 1).summary("Components, tunnels and cavities of a union of balls.");
    d.doc(
        "One row of a topology table: simplices of the dual complex of the union are counted, none is "
        "listed. "
        "Depends on one set of balls only, so that it runs beside whatever comes after, and is found in the "
        "cache "
        "when a later stage changes. Accepts and refuses what AlphaShape does.");
    d.avoid_when("the alpha-shape of the balls is made anyway: Topology takes its Betti numbers.");
    d.cites("edelsbrunner1995", "the union of balls and its dual shape").cites("kornberger2010", "2.6");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 32);
    d.input("balls", &UnionTopology::balls)
        .optional()
        .doc("n closed balls, model units; needed where no diagram is connected");
    d.input("diagram", &UnionTopology::diagram)
        .optional()
        .doc("their power diagram, instead of the balls (node PowerDiagram)");
    d.output("topology", &UnionTopology::topology).doc("the row of the stage");
    d.choice(
         "stage", &UnionTopology::options, &UnionTopologyOptions::stage,
         {{TopologyStage::inner, "inner",
           "inner polar balls as they come from LabelPoles, taken with the tolerance polar of PowerDiagram"},
          {TopologyStage::enlarged, "enlarged", "the balls before pruning, taken as they are"},
          {TopologyStage::kept, "kept", "the balls after pruning, taken as they are"}})
        .doc("which stage of a pipeline the balls are: the name of the row, and the tolerance");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if ((balls ? 1 : 0) + (diagram ? 1 : 0) != 1) {
      throw geometry::InputError(
          balls ? "both balls and a power diagram are connected" : "no balls are connected",
          "connect either balls, or the diagram of a node PowerDiagram");
    }
    topology = diagram ? geometry::union_row(*diagram, options, monitor)
                       : geometry::union_row(*balls, options, monitor);
  }
};

}  // namespace

const bf_node* union_topology_entry() { return node_entry<UnionTopology>(); }

}  // namespace ballflow::nodes
