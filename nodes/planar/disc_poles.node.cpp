#include "planar/disc_poles.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/planar_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::DiscPolesOptions;
using geometry::DiscVertices;

struct DiscPoles {
  In<geometry::Polygon2> polygon;
  Out<geometry::PointSet> points;
  Out<geometry::Balls> inner, outer;
  DiscPolesOptions options;

  static void declare(NodeDecl<DiscPoles>& d) {
    d.id("DiscPoles", 1)
        .summary("The discs of a polygon: Voronoi vertices of its boundary, inside and outside.");
    d.doc(
        "Samples the edges, no farther apart than the spacing and closer where edges are near to each other, "
        "until every piece between samples is an edge of their Delaunay triangulation with no sample in the "
        "circle over it. Every triangle then is inside or outside, and so is the center of its circle: these "
        "circles are the discs, balls with z = 0, which all nodes that take balls accept. With vertices = "
        "all "
        "the "
        "union of the inner discs contains the polygon, and reaches beyond it by at most half the spacing. "
        "The "
        "summary of `points` adds splits, how many samples are there beyond the spacing. Accepts any "
        "polygon. "
        "Refuses one without components, and edges so near to each other that samples would be closer than "
        "coordinates can tell.");
    d.avoid_when("the shape is a solid: VoronoiPoles and LabelPoles take meshes and clouds in space.");
    d.cites("kornberger2010", "5.4 and 3.4").cites("ruppert1995", "3");
    d.library("CGAL", geometry::cgal_version());
    d.memory(std::uint64_t{16} << 20, 400);
    d.input("polygon", &DiscPoles::polygon).doc("polygons with holes, model units");
    d.output("points", &DiscPoles::points).doc("the samples along the rings, z = 0");
    d.output("inner", &DiscPoles::inner).doc("discs inside, with the samples that they pass through");
    d.output("outer", &DiscPoles::outer)
        .doc("discs outside, of all triangles between the rings and the convex hull");
    d.param("spacing", &DiscPoles::options, &DiscPolesOptions::spacing)
        .unit("% of the longest bounding-box edge")
        .at_least(1e-4)
        .at_most(100)
        .doc("samples on an edge are no farther apart; half of it bounds how far discs reach beyond edges");
    d.choice(
         "vertices", &DiscPoles::options, &DiscPolesOptions::vertices,
         {{DiscVertices::all, "all", "every Voronoi vertex: the inner discs contain the polygon"},
          {DiscVertices::poles, "poles", "the farthest on either side of each sample only (thesis, 3.4)"}})
        .doc("which Voronoi vertices become discs");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::DiscPoles result = geometry::disc_poles(*polygon, options, monitor);
    points.summary("splits", result.splits);
    points = std::move(result.points);
    inner = std::move(result.inner);
    outer = std::move(result.outer);
  }
};

}  // namespace

const bf_node* disc_poles_entry() { return node_entry<DiscPoles>(); }

}  // namespace ballflow::nodes
