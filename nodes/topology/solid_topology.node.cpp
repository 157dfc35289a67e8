#include "topology/solid_topology.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

struct SolidTopology {
  In<geometry::TriangleMesh> mesh;
  Out<geometry::TopologyTable> topology;

  static void declare(NodeDecl<SolidTopology>& d) {
    d.id("SolidTopology", 1).summary("Components, tunnels and cavities of the solid inside a surface.");
    d.doc(
        "One row of a topology table. A surface that is open, not manifold, not orientable or intersects "
        "itself "
        "bounds no solid: its row is unknown, and a warning says why. A mesh without triangles (a cloud of "
        "points) "
        "has no row.");
    d.avoid_when("the surface is known to be open.");
    d.cites("kornberger2010", "3.5");
    d.memory(1 << 20, 16);
    d.input("mesh", &SolidTopology::mesh).doc("the surface of the solid");
    d.output("topology", &SolidTopology::topology).doc("the row `surface`, or none");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    topology = geometry::solid_row(*mesh, monitor);
  }
};

}  // namespace

const bf_node* solid_topology_entry() { return node_entry<SolidTopology>(); }

}  // namespace ballflow::nodes
