#include "poles/voronoi_poles.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::Vertices;
using geometry::VoronoiPolesOptions;

struct VoronoiPoles {
  In<geometry::PointSet> points;
  In<geometry::TriangleMesh> mesh;
  Out<geometry::PoleSet> poles;
  VoronoiPolesOptions options;

  static void declare(NodeDecl<VoronoiPoles>& d) {
    d.id("VoronoiPoles", 2);
    d.summary("The two poles of every sample: far vertices of its Voronoi cell on either side.");
    d.doc(
        "The first pole of a sample is the vertex of its Voronoi cell farthest from it, the second the "
        "farthest behind that. Where they are less than 138.6 degrees apart, as at sharp edges, both may be "
        "on one side of the surface: all bounded vertices behind the first are kept as candidates, among "
        "which LabelPoles finds a third pole on the other side. With vertices = all every bounded vertex is "
        "in "
        "the result: the balls of all inner ones have no holes inside, however thin the solid. Far-away "
        "points around the sample bound all "
        "cells; Voronoi vertices that depend on them lie well outside the bounding box and are marked "
        "unbounded. Vertices that coincide exactly (five and more cospherical samples) are one. Accepts any "
        "distinct points that are not all in one plane; refuses fewer than 4 points, equal points and "
        "coplanar points.");
    d.avoid_when(
        "the points do not sample a surface: poles of points that fill a volume or follow curves mean "
        "nothing.");
    d.cites("amenta1999", "section 4, poles").cites("kornberger2010", "3.3, 3.4");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 40);
    d.input("points", &VoronoiPoles::points).doc("n points on a surface, model units");
    d.input("mesh", &VoronoiPoles::mesh)
        .optional()
        .doc("the surface that was sampled; only whether it is closed matters, to vertices = auto");
    d.output("poles", &VoronoiPoles::poles)
        .doc("the distinct poles and the candidates, not labelled, and the two poles of every sample");
    d.choice("vertices", &VoronoiPoles::options, &VoronoiPolesOptions::vertices,
             {{Vertices::automatic, "auto", "all with a closed mesh, else poles"},
              {Vertices::poles, "poles", "poles, and candidates where both may be on one side (thesis, 3.4)"},
              {Vertices::all, "all", "poles and all bounded vertices: about seven for a sample, both sides"}})
        .doc("which Voronoi vertices are in the result");
    d.param("bounding_distance", &VoronoiPoles::options, &VoronoiPolesOptions::bounding_distance)
        .unit("longest bounding-box edges")
        .at_least(4)
        .at_most(1e6)
        .doc(
            "distance of the far-away points; it matters only to unbounded poles: larger values move them "
            "farther away");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    options.vertices = geometry::decide(options.vertices, mesh ? *mesh : geometry::TriangleMesh{});
    poles = geometry::voronoi_poles(*points, options, monitor);
  }
};

}  // namespace

const bf_node* voronoi_poles_entry() { return node_entry<VoronoiPoles>(); }

}  // namespace ballflow::nodes
