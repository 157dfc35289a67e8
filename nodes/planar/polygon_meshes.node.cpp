#include "planar/polygon_meshes.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/planar_types.hpp"

namespace ballflow::nodes {
namespace {

struct PolygonMeshes {
  In<geometry::Polygon2> polygon;
  Out<geometry::TriangleMesh> flat, prism;

  static void declare(NodeDecl<PolygonMeshes>& d) {
    d.id("PolygonMeshes", 2).summary("Triangles that tile a polygon, and a prism over it.");
    d.doc(
        "So that what nodes prove of meshes in space holds in the plane: balls with z = 0 contain `flat` "
        "where the discs contain the polygon, and reach out of `prism` where the discs reach out of the "
        "polygon. The prism is high enough for all discs that are no larger than the polygon. Accepts "
        "polygons with holes, of several components. Refuses rings that cross or touch.");
    d.avoid_when("a solid is wanted: a prism of a height of one's own is made elsewhere.");
    d.cites("ruppert1995", "1: constrained Delaunay triangulations");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 400);
    d.input("polygon", &PolygonMeshes::polygon).doc("polygons, model units");
    d.output("flat", &PolygonMeshes::flat)
        .doc("triangles in the plane z = 0: the polygon, open as a surface");
    d.output("prism", &PolygonMeshes::prism)
        .doc("the closed surface of the polygon from z = -2 L to 2 L, L its longest bounding-box edge");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::PolygonMeshes meshes = geometry::polygon_meshes(*polygon, monitor);
    flat = std::move(meshes.flat);
    prism = std::move(meshes.prism);
  }
};

}  // namespace

const bf_node* polygon_meshes_entry() { return node_entry<PolygonMeshes>(); }

}  // namespace ballflow::nodes
