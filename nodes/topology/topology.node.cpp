#include "topology/topology.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

struct Topology {
  In<geometry::TriangleMesh> mesh;
  In<geometry::Balls> inner, enlarged, kept;
  In<geometry::SimplicialComplex> complex;
  In<geometry::MedialAxis> axis;
  Out<geometry::TopologyTable> table;

  static void declare(NodeDecl<Topology>& d) {
    d.id("Topology", 1).summary("Components, tunnels and cavities of a shape at every stage of a pipeline.");
    d.doc(
        "One row per connected input: Euler characteristic and Betti numbers of the solid inside the "
        "surface, "
        "of unions of balls, of an alpha-shape, and of a medial axis from its own polygons. What differs "
        "from "
        "one row to the next is said in words, as a warning and in the summary. Equal numbers do not prove "
        "that two shapes have the same topology; TopologyRepair does. A surface that is open, not manifold, "
        "or "
        "intersects itself bounds no solid: its row is unknown. Refuses to run with nothing connected.");
    d.avoid_when("a proof is needed that pruning kept the topology: TopologyRepair compares loop by loop.");
    d.cites("kornberger2010", "3.5 and 3.6.5")
        .cites("edelsbrunner1995", "the union of balls and its dual shape");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 32);
    d.input("mesh", &Topology::mesh).optional().doc("the surface of the solid");
    d.input("inner", &Topology::inner)
        .optional()
        .doc("inner polar balls as they come from LabelPoles, taken with the tolerance polar of AlphaShape");
    d.input("enlarged", &Topology::enlarged).optional().doc("the balls before pruning, taken as they are");
    d.input("kept", &Topology::kept)
        .optional()
        .doc("the balls after pruning, taken as they are; leave it out where complex is their alpha-shape");
    d.input("complex", &Topology::complex).optional().doc("the alpha-shape of the balls after pruning");
    d.input("axis", &Topology::axis).optional().doc("the medial axis of their union");
    d.output("topology", &Topology::table).doc("one row per connected input");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    const auto address = [](const auto& port) { return port ? &*port : nullptr; };
    table = geometry::topology(
        {address(mesh), address(inner), address(enlarged), address(kept), address(complex), address(axis)},
        monitor);
  }
};

}  // namespace

const bf_node* topology_entry() { return node_entry<Topology>(); }

}  // namespace ballflow::nodes
