#include "planar/simplify_polygon.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/artifact_types.hpp"
#include "types/planar_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::SimplifyPolygonOptions;

struct SimplifyPolygon {
  In<geometry::Polygon2> polygon;
  Out<geometry::Polygon2> simplified;
  SimplifyPolygonOptions options;

  static void declare(NodeDecl<SimplifyPolygon>& d) {
    d.id("SimplifyPolygon", 1).summary("Polygons with fewer corners, whose boundary hardly moves.");
    d.doc(
        "Leaves corners out, along each ring as many at once as an edge can replace: neither the old "
        "boundary "
        "nor the new one is farther from the other than the tolerance. Coast lines and traced outlines have "
        "a "
        "hundred corners where their discs need one. No rings cross or touch afterwards, and each lies in "
        "the "
        "ones it lay in, decided exactly; where they would not, the tolerance is halved, and a warning says "
        "so. "
        "The summary of `simplified` adds corners, how many there were, and moved_at_most, model units. What "
        "is "
        "proven of discs should be proven for the polygon as it was read (PolygonMeshes).");
    d.avoid_when("every corner counts, as in a polygon drawn by hand: with tolerance 0 it stays as it is.");
    d.cites("zhao1997", "sleeve fitting");
    d.memory(std::uint64_t{4} << 20, 100);
    d.input("polygon", &SimplifyPolygon::polygon)
        .doc("polygons with holes whose rings do not touch, model units");
    d.output("simplified", &SimplifyPolygon::simplified)
        .doc("the same rings with fewer corners, all of them corners of the input");
    d.param("tolerance", &SimplifyPolygon::options, &SimplifyPolygonOptions::tolerance)
        .unit("% of the longest bounding-box edge")
        .at_least(0)
        .at_most(100)
        .doc("how far the boundary may move; 0: not at all");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::SimplifiedPolygon result = geometry::simplify_polygon(*polygon, options, monitor);
    if (result.lowered)
      monitor.warn(
          "with the tolerance asked for rings would have met or changed sides; the boundary moved by " +
          std::to_string(result.tolerance) + " model units at most");
    simplified.summary("corners", static_cast<std::int64_t>(polygon->vertices.size()));
    simplified.summary("moved_at_most", result.tolerance);
    simplified = std::move(result.polygon);
  }
};

}  // namespace

const bf_node* simplify_polygon_entry() { return node_entry<SimplifyPolygon>(); }

}  // namespace ballflow::nodes
