#include "sample/wrap.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::WrapOptions;

struct Wrap {
  In<geometry::TriangleMesh> mesh;
  Out<geometry::TriangleMesh> wrapped;
  WrapOptions options;

  static void declare(NodeDecl<Wrap>& d) {
    d.id("Wrap", 1).summary("A closed surface around an open one, so that it has an inside.");
    d.doc(
        "The alpha wrap of the triangles: closed, manifold, free of self-intersections, and about `offset` "
        "outside "
        "of them. Holes narrower than `alpha` are closed; through wider ones the wrap enters, so that an "
        "open sheet "
        "becomes a shell around it. Accepts any triangles.");
    d.avoid_when("the surface is closed already: the wrap is farther out and has rounded corners.");
    d.cites("portaneri2022", "alpha wrapping").library("CGAL", geometry::cgal_version());
    d.memory(std::uint64_t{64} << 20, 16);
    d.input("mesh", &Wrap::mesh).doc("any triangles, model units");
    d.output("mesh", &Wrap::wrapped).doc("the surface around them, outwards");
    d.param("alpha", &Wrap::options, &WrapOptions::alpha)
        .unit("% of the longest bounding-box edge")
        .at_least(0.01)
        .at_most(50)
        .doc("holes narrower than this are closed");
    d.param("offset", &Wrap::options, &WrapOptions::offset)
        .unit("% of the longest bounding-box edge")
        .at_least(0.01)
        .at_most(50)
        .doc("how far outside the result lies");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    wrapped = geometry::wrap(*mesh, options, monitor);
  }
};

}  // namespace

const bf_node* wrap_entry() { return node_entry<Wrap>(); }

}  // namespace ballflow::nodes
