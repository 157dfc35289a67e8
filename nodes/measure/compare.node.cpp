#include "measure/compare.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct Compare {
  In<Balls> balls;
  In<PointSet> points;
  In<TriangleMesh> mesh;
  Out<Comparison> comparison;
  CompareOptions options;

  static void declare(NodeDecl<Compare>& d) {
    d.id("Compare", 3).summary("Measure how far a union of balls is from a surface.");
    d.doc(
        "Hausdorff distances both ways between the surface and the boundary of the union, with bounds that "
        "hold for every point between the samples; mean distances, coverage, protrusion, and volumes, which "
        "are not sampled: that of the union by the formulas of UnionMeasure, that of a closed mesh with its "
        "components turned outwards, but for cavities, as in LabelPoles. Without a mesh the points "
        "themselves "
        "are the surface. Accepts any mesh and any balls; refuses an empty set of balls, no surface at all, "
        "and "
        "a spacing that needs more than 30 million samples.");
    d.avoid_when("only the samples matter: VerifyCover is exact and faster.");
    d.cites("kornberger2010", "3.5 and 3.9").cites("aspert2002", "2");
    d.cites("edelsbrunner1995", "the dual complex, from which the volume follows");
    d.library("CGAL", cgal_version());
    d.input("balls", &Compare::balls).doc("the balls");
    d.input("points", &Compare::points).doc("samples of the surface; used when there is no mesh");
    d.input("mesh", &Compare::mesh).optional().doc("the surface");
    d.output("comparison", &Compare::comparison)
        .doc("distances and volumes in model units, and what kind of surface it was");
    d.param("spacing", &Compare::options, &CompareOptions::spacing)
        .unit("% of the longest bounding-box edge")
        .above(0)
        .at_most(100)
        .doc("no point of a surface is farther from a sample; time grows with its inverse square");
    d.memory(64 << 20, 40);  // the alpha-shape of the balls, and samples
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    comparison = compare(*balls, *points, mesh ? *mesh : TriangleMesh(), options, monitor);
  }
};

}  // namespace

const bf_node* compare_entry() { return node_entry<Compare>(); }

}  // namespace ballflow::nodes
