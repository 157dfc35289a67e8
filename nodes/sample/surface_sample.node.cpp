#include "sample/surface_sample.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::Spread;
using geometry::SurfaceSampleOptions;

struct SampleMesh {
  In<geometry::TriangleMesh> mesh;
  Out<geometry::PointSet> points;
  SurfaceSampleOptions options;

  static void declare(NodeDecl<SampleMesh>& d) {
    d.id("SampleMesh", 1).summary("Points spread over the surface of a mesh, with normals.");
    d.doc(
        "What Sample does with mode surface, for a mesh that another node made. Accepts any triangles, open "
        "and non-manifold ones too. Refuses a mesh without area.");
    d.avoid_when("the samples are to follow the shape: Refine chooses such.");
    d.cites("yuksel2015", "3").uses_seed();
    d.memory(std::uint64_t{16} << 20, 2);
    d.input("mesh", &SampleMesh::mesh).doc("m triangles, model units");
    d.output("points", &SampleMesh::points).doc("n points on the triangles, with their normals");
    d.choice("spread", &SampleMesh::options, &SurfaceSampleOptions::spread,
             {{Spread::poisson, "poisson", "evenly spaced: five times as many random points, thinned out"},
              {Spread::random, "random", "independent and uniform by area"}})
        .doc("how points lie on the faces");
    d.param("count", &SampleMesh::options, &SurfaceSampleOptions::count)
        .unit("points")
        .at_least(4)
        .at_most(2e6)
        .doc("number of points");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    SurfaceSampleOptions wanted = options;
    wanted.seed = context.seed();
    points = geometry::sample_surface(*mesh, wanted, monitor);
  }
};

}  // namespace

const bf_node* sample_mesh_entry() { return node_entry<SampleMesh>(); }

}  // namespace ballflow::nodes
