#include "measure/union_measure.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

struct UnionMeasure {
  In<geometry::SimplicialComplex> complex;
  In<geometry::PowerDiagram> diagram;
  Out<geometry::MassProperties> measure;

  static void declare(NodeDecl<UnionMeasure>& d) {
    d.id("UnionMeasure", 2).summary("Volume, area, centre of mass and inertia tensor of a union of balls.");
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
    d.output("measure", &UnionMeasure::measure).doc("at density 1, in powers of model units");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    measure = diagram ? geometry::union_measure(*complex, *diagram, monitor)
                      : geometry::union_measure(*complex, monitor);
  }
};

}  // namespace

const bf_node* union_measure_entry() { return node_entry<UnionMeasure>(); }

}  // namespace ballflow::nodes
