#include "measure/union_measure.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "exact/cgal_version.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

struct UnionMeasure {
  In<geometry::SimplicialComplex> complex;
  In<geometry::PowerDiagram> diagram;
  In<geometry::TriangleMesh> mesh;
  Out<geometry::MassProperties> measure;
  geometry::SolidVolumeOptions options;

  static void declare(NodeDecl<UnionMeasure>& d) {
    d.id("UnionMeasure", 3).summary("Volume, area, centre of mass and inertia tensor of a union of balls.");
    d.doc(
        "By formulas on the patches, arcs and corners of the boundary, which the alpha-shape names: nothing "
        "is "
        "sampled. Accepts every alpha-shape: empty, flat, of touching balls, with cavities, of several "
        "components.");
    d.avoid_when("the volume of the solid itself is wanted: the union of few balls deviates; see Compare.");
    d.cites("edelsbrunner1995", "the dual complex of a union of balls");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 10);
    d.input("complex", &UnionMeasure::complex).doc("the alpha-shape of the balls (node AlphaShape)");
    d.input("diagram", &UnionMeasure::diagram)
        .optional()
        .doc("the power diagram that the alpha-shape was read off: nothing is searched in it again");
    d.input("mesh", &UnionMeasure::mesh)
        .optional()
        .doc("the solid that the union stands for: where it is closed its exact volume is compared with");
    d.output("measure", &UnionMeasure::measure)
        .doc(
            "at density 1, in powers of model units; with a closed mesh the summary adds solid_volume, "
            "volume_error, (union - solid) / solid, and solid_volume_exact: false where the surface crosses "
            "itself, or has "
            "triangles twice, so that the volume is counted on lines, to about a thousandth");
    d.param("tolerance", &UnionMeasure::options, &geometry::SolidVolumeOptions::tolerance)
        .unit("% of the volume of the solid")
        .at_least(0)
        .doc("a union whose volume is farther off is a warning");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::MassProperties result = diagram ? geometry::union_measure(*complex, *diagram, monitor)
                                              : geometry::union_measure(*complex, monitor);
    if (mesh) {
      if (const auto solid = geometry::compare_volume(result, *mesh, options, monitor)) {
        measure.summary("solid_volume", solid->volume);
        measure.summary("volume_error", solid->error);
        measure.summary("solid_volume_exact", solid->exact);
        if (!solid->warning.empty()) monitor.warn(solid->warning);
      }
    }
    measure = std::move(result);
  }
};

}  // namespace

const bf_node* union_measure_entry() { return node_entry<UnionMeasure>(); }

}  // namespace ballflow::nodes
