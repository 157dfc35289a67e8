#include "planar/disc_union_outline.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/planar_types.hpp"

namespace ballflow::nodes {
namespace {

struct OutlineOptions {
  double error = 0.05;  // % of the longest edge of the bounding box
};

struct DiscUnionOutline {
  In<geometry::Balls> balls;
  Out<geometry::DiscOutline> outline;
  Out<geometry::Polygon2> polygon;
  OutlineOptions options;

  static void declare(NodeDecl<DiscUnionOutline>& d) {
    d.id("DiscUnionOutline", 1).summary("The outline of a union of discs: its arcs, and a polygon in it.");
    d.doc(
        "The arcs on the boundary of the union, joined to rings, outer ones and holes. Which arcs there are "
        "and "
        "how they join is decided exactly; their ends are rounded, and area and perimeter are by formulas. "
        "The "
        "polygon has its corners on the arcs: it is inside the union, and no point of the outline is farther "
        "from it than its `error`, which the summary has in model units. Accepts any balls with z = 0: none, "
        "equal, nested, touching ones, on a line; points have no outline. Refuses another z, and numbers "
        "that "
        "are not 0 and outside [1e-150, 1e150].");
    d.avoid_when(
        "only area or topology is wanted of balls in space: UnionMeasure and UnionTopology have those.");
    d.cites("kornberger2010", "5.4").cites("edelsbrunner1995", "dual complex");
    d.library("CGAL", geometry::cgal_version());
    d.memory(std::uint64_t{16} << 20, 40);
    d.input("balls", &DiscUnionOutline::balls).doc("discs, model units: balls with z = 0");
    d.output("outline", &DiscUnionOutline::outline).doc("rings of arcs, the union on the left");
    d.output("polygon", &DiscUnionOutline::polygon)
        .doc("polygons inside the union, with corners on the arcs");
    d.param("error", &DiscUnionOutline::options, &OutlineOptions::error)
        .unit("% of the longest bounding-box edge of the union")
        .at_least(1e-6)
        .at_most(100)
        .doc("no point of the outline is farther from the polygon");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::DiscOutline arcs = geometry::disc_union_outline(*balls, monitor);
    const double error = options.error / 100 * geometry::bounding_box(arcs).longest_edge();
    polygon.summary("error", error);
    if (arcs.rings() == 0) {
      polygon = geometry::Polygon2{{}, {0}, {0}};
    } else {
      polygon = geometry::polygon_in(arcs, error);
    }
    outline = std::move(arcs);
  }
};

}  // namespace

const bf_node* disc_union_outline_entry() { return node_entry<DiscUnionOutline>(); }

}  // namespace ballflow::nodes
