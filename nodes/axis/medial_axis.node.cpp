#include "axis/medial_axis.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::AxisMismatch;
using geometry::MedialAxisOptions;

struct MedialAxis {
  In<geometry::SimplicialComplex> complex;
  In<geometry::PowerDiagram> diagram;
  Out<geometry::MedialAxis> axis;
  MedialAxisOptions options;

  static void declare(NodeDecl<MedialAxis>& d) {
    d.id("MedialAxis", 5).summary("The medial axis of a union of balls as a polygon complex.");
    d.doc(
        "Simplices of the alpha-shape that belong to no tetrahedron, and inside its tetrahedra the Voronoi "
        "diagram of "
        "the vertices of the union's boundary. The axis is homotopy equivalent to the union; its Betti "
        "numbers, counted "
        "from its own polygons, are compared with those of the alpha-shape. Accepts every alpha-shape: "
        "empty, flat or "
        "nearly flat, with cavities, of several components, of balls on a grid. Doubles are tried first; "
        "where rounding "
        "hides the structure the axis is made again with exact decisions, which takes some ten times as "
        "long. Polygons "
        "are labelled by sheets, the components after cutting at edges of three and more polygons, and "
        "oriented sheet "
        "by sheet; those edges are the seams.");
    d.avoid_when(
        "the alpha-shape is that of polar balls that were not enlarged: many balls then meet in one sample, "
        "so that "
        "everything is decided exactly. 85 000 balls take two minutes.");
    d.cites("amenta2001", "the medial axis of a union of balls").cites("kornberger2010", "3.7");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 30);
    d.input("complex", &MedialAxis::complex).doc("the alpha-shape of the balls (node AlphaShape)");
    d.input("diagram", &MedialAxis::diagram)
        .optional()
        .doc("the power diagram that the alpha-shape was read off: nothing is searched in it again");
    d.output("axis", &MedialAxis::axis)
        .doc("polygons, edges in no polygon and isolated vertices, with the radius of the inscribed ball");
    d.choice("on_mismatch", &MedialAxis::options, &MedialAxisOptions::on_mismatch,
             {{AxisMismatch::warn, "warn", "say so and go on"},
              {AxisMismatch::error, "error", "fail: nothing that follows sees an axis of another topology"}})
        .doc(
            "what happens when the axis and the union differ in components, tunnels or cavities: the "
            "alpha-shape is then "
            "not that of its balls");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    axis = diagram ? geometry::medial_axis(*complex, *diagram, options, monitor)
                   : geometry::medial_axis(*complex, options, monitor);
    axis.summary("expected_euler_characteristic", complex->euler_characteristic());
  }
};

}  // namespace

const bf_node* medial_axis_entry() { return node_entry<MedialAxis>(); }

}  // namespace ballflow::nodes
