#include "prior/split_components.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::SplitComponentsOptions;

struct SplitComponents {
  In<geometry::TriangleMesh> mesh;
  Out<geometry::TriangleMesh> component;
  SplitComponentsOptions options;

  static void declare(NodeDecl<SplitComponents>& d) {
    d.id("SplitComponents", 1).summary("One connected component of a mesh.");
    d.doc(
        "Several objects in one file become one mesh each, by a map over their numbers. Triangles hang "
        "together "
        "by common vertices. Accepts any triangles. Refuses a mesh without any, and numbers beyond the last "
        "component.");
    d.avoid_when("components bound one solid together: a cavity is a component of its own.");
    d.cites("cormen2009", "connected components by disjoint sets");
    d.memory(1 << 20, 4);
    d.input("mesh", &SplitComponents::mesh).doc("any triangles, equal vertices welded");
    d.output("mesh", &SplitComponents::component)
        .doc("triangles and vertices of the component, in their order");
    d.param("component", &SplitComponents::options, &SplitComponentsOptions::component)
        .unit("number")
        .at_least(0)
        .at_most(1e9)
        .doc("which one, from 0 on: by area, the largest first");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::MeshComponent found = geometry::split_components(*mesh, options, monitor);
    component = std::move(found.mesh);
    component.summary("components", found.components);
  }
};

}  // namespace

const bf_node* split_components_entry() { return node_entry<SplitComponents>(); }

}  // namespace ballflow::nodes
