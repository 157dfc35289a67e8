#include "topology/topology.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

struct Topology {
  In<geometry::TopologyTable> surface, inner, enlarged, kept;
  In<geometry::SimplicialComplex> complex;
  In<geometry::MedialAxis> axis;
  Out<geometry::TopologyTable> table;

  static void declare(NodeDecl<Topology>& d) {
    d.id("Topology", 2).summary("Compare components, tunnels and cavities along a pipeline.");
    d.doc(
        "One row per connected input: Euler characteristic and Betti numbers of the solid inside the surface "
        "(SolidTopology), of unions of balls (UnionTopology), of an alpha-shape, and of a medial axis from "
        "its "
        "own polygons. What differs from one row to the next is said in words, as a warning and in the "
        "summary. "
        "Equal numbers do not prove that two shapes have the same topology; TopologyRepair does. Refuses to "
        "run "
        "with nothing connected.");
    d.avoid_when("a proof is needed that pruning kept the topology: TopologyRepair compares loop by loop.");
    d.cites("kornberger2010", "3.5 and 3.6.5");
    d.memory(1 << 20, 8);
    d.input("surface", &Topology::surface).optional().doc("SolidTopology of the surface");
    d.input("inner", &Topology::inner).optional().doc("UnionTopology of the inner polar balls, stage inner");
    d.input("enlarged", &Topology::enlarged)
        .optional()
        .doc("UnionTopology of the balls before pruning, stage enlarged");
    d.input("kept", &Topology::kept)
        .optional()
        .doc(
            "UnionTopology of the balls after pruning, stage kept; leave it out where complex is their "
            "alpha-shape");
    d.input("complex", &Topology::complex).optional().doc("the alpha-shape of the balls after pruning");
    d.input("axis", &Topology::axis).optional().doc("the medial axis of their union");
    d.output("topology", &Topology::table).doc("one row per connected input");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    const auto address = [](const auto& port) { return port ? &*port : nullptr; };
    table = geometry::topology(
        {address(surface), address(inner), address(enlarged), address(kept), address(complex), address(axis)},
        monitor);
  }
};

}  // namespace

const bf_node* topology_entry() { return node_entry<Topology>(); }

}  // namespace ballflow::nodes
