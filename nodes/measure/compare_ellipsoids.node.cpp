#include "measure/compare_ellipsoids.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct CompareEllipsoids {
  In<Ellipsoids> ellipsoids;
  In<PointSet> points;
  In<TriangleMesh> mesh;
  Out<Comparison> comparison;
  CompareOptions options;

  static void declare(NodeDecl<CompareEllipsoids>& d) {
    d.id("CompareEllipsoids", 1).summary("Measure how far a union of ellipsoids is from a surface.");
    d.doc(
        "What Compare measures of balls: Hausdorff distances both ways between the surface and the boundary "
        "of "
        "the union, with bounds that hold for every point between the samples, mean distances, coverage and "
        "volumes. protrusion bounds how far an ellipsoid with its center inside reaches beyond the surface: "
        "the "
        "least length by which its half-axes have to be shortened so that it does not meet the surface any "
        "more; no samples are in it. The union's volume is counted along 512 x 512 lines. Looks at triangles "
        "and "
        "ellipsoids alone, in their own space, however they were made. Without a mesh the points are the "
        "surface. "
        "Refuses no ellipsoids, no surface, and a spacing that needs more than 30 million samples.");
    d.avoid_when("only the samples matter: VerifyEllipsoids is exact and faster.");
    d.cites("kornberger2010", "6.4").cites("aspert2002", "2");
    d.input("ellipsoids", &CompareEllipsoids::ellipsoids).doc("the ellipsoids");
    d.input("points", &CompareEllipsoids::points).doc("samples of the surface; used when there is no mesh");
    d.input("mesh", &CompareEllipsoids::mesh).optional().doc("the surface");
    d.output("comparison", &CompareEllipsoids::comparison)
        .doc("distances and volumes in model units, and what kind of surface it was");
    d.param("spacing", &CompareEllipsoids::options, &CompareOptions::spacing)
        .unit("% of the longest bounding-box edge")
        .above(0)
        .at_most(100)
        .doc("no point of a surface is farther from a sample; time grows with its inverse square");
    d.memory(64 << 20, 40);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    comparison = compare_ellipsoids(*ellipsoids, *points, mesh ? *mesh : TriangleMesh(), options, monitor);
  }
};

}  // namespace

const bf_node* compare_ellipsoids_entry() { return node_entry<CompareEllipsoids>(); }

}  // namespace ballflow::nodes
