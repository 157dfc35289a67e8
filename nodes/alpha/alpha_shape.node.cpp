#include "power/alpha_shape.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::AlphaShapeOptions;
using geometry::AlphaTolerance;

struct AlphaShape {
  In<geometry::Balls> balls;
  In<geometry::PowerDiagram> diagram;
  Out<geometry::SimplicialComplex> complex;
  AlphaShapeOptions options;

  static void declare(NodeDecl<AlphaShape>& d) {
    d.id("AlphaShape", 1).summary("The weighted zero alpha-shape of balls: the dual complex of their union.");
    d.doc(
        "Simplices of the regular triangulation of the balls whose smallest orthogonal sphere has a squared "
        "radius <= 0, decided exactly, with their faces. The complex is homotopy equivalent to the union of "
        "the "
        "closed balls; its Betti numbers are those of the union. Accepts any set of balls: none, flat, "
        "nested, "
        "touching or equal ones; of balls with one center the largest counts, the first of equal ones. "
        "Refuses "
        "radii that are negative or whose square overflows.");
    d.avoid_when(
        "the balls are polar balls that were not enlarged and tolerance is none: rounding then decides "
        "which of the many balls through a sample touch.");
    d.cites("kornberger2010", "2.6").cites("edelsbrunner1995", "the union of balls and its dual shape");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 32);  // 950 bytes per ball were measured
    d.input("balls", &AlphaShape::balls)
        .optional()
        .doc("n closed balls, model units; needed where no diagram is connected");
    d.input("diagram", &AlphaShape::diagram)
        .optional()
        .doc("their power diagram, instead of the balls (node PowerDiagram): nothing is triangulated again");
    d.output("complex", &AlphaShape::complex)
        .doc("the dual complex over the n balls, with classes and Betti numbers");
    d.choice("tolerance", &AlphaShape::options, &AlphaShapeOptions::tolerance,
             {{AlphaTolerance::none, "none",
               "the balls are taken as they are: enlarged or other balls in general position"},
              {AlphaTolerance::polar, "polar",
               "2^-36 of the squared longest bounding-box edge is added to every squared radius, so that "
               "polar balls "
               "through one sample overlap whatever rounding says; recorded as delta"}})
        .doc("what is added to squared radii before anything is decided; a diagram brings its own");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if ((balls ? 1 : 0) + (diagram ? 1 : 0) != 1) {
      throw geometry::InputError(
          balls ? "both balls and a power diagram are connected" : "no balls are connected",
          "connect either balls, or the diagram of a node PowerDiagram");
    }
    complex =
        diagram ? geometry::alpha_shape(*diagram, monitor) : geometry::alpha_shape(*balls, options, monitor);
  }
};

}  // namespace

const bf_node* alpha_shape_entry() { return node_entry<AlphaShape>(); }

}  // namespace ballflow::nodes
