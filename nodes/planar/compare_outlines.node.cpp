#include "planar/compare_outlines.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/planar_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::CompareOutlinesOptions;

struct CompareOutlines {
  In<geometry::Polygon2> a, b;
  Out<geometry::OutlineComparison> comparison;
  CompareOutlinesOptions options;

  static void declare(NodeDecl<CompareOutlines>& d) {
    d.id("CompareOutlines", 1)
        .summary("The difference of two polygons: areas, and distances of their boundaries.");
    d.doc(
        "The areas of both, of what is inside one of them alone, from an exact overlay; and how far the "
        "boundary "
        "of each is from that of the other, at least and at most. Accepts polygons with holes and in several "
        "parts. Where rings of one cross or touch, areas are unknown, and a warning says where. Refuses one "
        "that is empty where the other is not.");
    d.avoid_when("shapes are solids: Compare measures meshes against balls.");
    d.cites("kornberger2010", "5.4").cites("fogel2012", "Boolean operations of polygons");
    d.library("CGAL", geometry::cgal_version());
    d.memory(std::uint64_t{32} << 20, 200);
    d.input("a", &CompareOutlines::a).doc("polygons, model units: what should be there");
    d.input("b", &CompareOutlines::b).doc("polygons, model units: what is there");
    d.output("comparison", &CompareOutlines::comparison).doc("areas and distances");
    d.param("spacing", &CompareOutlines::options, &CompareOutlinesOptions::spacing)
        .unit("% of the longest bounding-box edge of a")
        .at_least(1e-5)
        .at_most(100)
        .doc(
            "samples on the boundaries are no farther apart; what is between at least and at most shrinks "
            "with it");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    comparison = geometry::compare_outlines(*a, *b, options, monitor);
  }
};

}  // namespace

const bf_node* compare_outlines_entry() { return node_entry<CompareOutlines>(); }

}  // namespace ballflow::nodes
