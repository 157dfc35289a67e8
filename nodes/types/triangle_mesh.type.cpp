#include "types/triangle_mesh.hpp"

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::TriangleMesh>::declare(TypeDecl<geometry::TriangleMesh>& d) {
  using T = geometry::TriangleMesh;
  d.id("TriangleMesh", 1)
      .doc("An indexed set of triangles; it may be open or non-manifold, the summary says so.");
  d.array("vertices", &T::vertices).length("v").doc("coordinates, model units");
  d.array("triangles", &T::triangles).length("f").doc("vertex indices");
  d.summary("vertices", "number of vertices").summary("faces", "number of triangles");
  d.summary("closed", "every edge belongs to exactly two triangles");
  d.summary("manifold", "edges have at most two triangles, vertex stars are one disk or half disk");
  d.summary("oriented", "no two triangles run through a shared edge in the same direction");
  d.summary("genus",
            "total over the components, boundary loops filled; null when not manifold or not oriented");
  d.summary("components", "connected components")
      .summary("boundary_loops", "closed chains of boundary edges");
  d.summarize([](const T& v) {
    const geometry::MeshTopology t = geometry::mesh_topology(v);
    return Summary{
        {"vertices", t.vertices},     {"faces", t.faces},
        {"closed", t.closed},         {"manifold", t.manifold},
        {"oriented", t.oriented},     {"genus", t.genus < 0 ? SummaryValue(nullptr) : SummaryValue(t.genus)},
        {"components", t.components}, {"boundary_loops", t.boundary_loops}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
