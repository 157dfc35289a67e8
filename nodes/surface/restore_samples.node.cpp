#include "surface/restore_samples.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

struct RestoreSamples {
  In<geometry::TriangleMesh> surface;
  In<geometry::SurfaceReport> report;
  In<geometry::Balls> balls;
  In<geometry::PointSet> original;
  Out<geometry::TriangleMesh> mesh;
  bool keep = true;

  static void declare(NodeDecl<RestoreSamples>& d) {
    d.id("RestoreSamples", 1).summary("Put a surface through denoised samples back onto the samples.");
    d.doc(
        "Every vertex that is the centre of a surface ball moves to the sample of that ball as it came, "
        "before Denoise; midpoints stay. The triangles stay, so the mesh is closed, oriented and manifold "
        "as before, but where samples moved farther than triangles are wide some may cross. Without "
        "denoising nothing changes. With keep = false the mesh is handed on. Refuses reports, balls and "
        "samples that do not belong to the mesh.");
    d.avoid_when("a smooth surface is wanted: the noise comes back (keep = false).");
    d.cites("kornberger2010", "4.5.3, whose vertices are samples");
    d.memory(1 << 20, 2.0);
    d.input("mesh", &RestoreSamples::surface).doc("the surface, as SurfaceMesh makes it");
    d.input("report", &RestoreSamples::report).doc("its report");
    d.input("balls", &RestoreSamples::balls).doc("the kept surface balls");
    d.input("original", &RestoreSamples::original).doc("all samples as they came");
    d.output("mesh", &RestoreSamples::mesh).doc("the surface, its vertices unmoved samples");
    d.param("keep", &RestoreSamples::keep).doc("false: vertices stay where denoising moved them");
  }
  void run(RunContext&) {
    mesh = keep ? geometry::restore_samples(*surface, *report, *balls, *original) : *surface;
  }
};

}  // namespace

const bf_node* restore_samples_entry() { return node_entry<RestoreSamples>(); }

}  // namespace ballflow::nodes
