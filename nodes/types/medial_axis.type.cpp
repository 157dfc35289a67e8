#include "types/medial_axis.hpp"

#include <algorithm>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::MedialAxis>::declare(TypeDecl<geometry::MedialAxis>& d) {
  using T = geometry::MedialAxis;
  d.id("MedialAxis", 2)
      .doc("The medial axis of a union of balls as a polygon complex with a radius at every vertex.");
  d.array("vertices", &T::vertices).length("v").doc("model units");
  d.array("radii", &T::radii).length("v").doc("radius of the maximal inscribed ball, model units");
  d.array("edges", &T::edges).length("e").doc("vertex pairs of edges that bound no polygon");
  d.array("polygon_offsets", &T::polygon_offsets).length("f+1").doc("where the corners of a polygon begin");
  d.array("polygon_vertices", &T::polygon_vertices).length("k").doc("corners in order around the polygon");
  d.array("polygon_kinds", &T::polygon_kinds).length("f").doc("0 singular triangle, 1 Voronoi facet, 2 wall");
  d.array("polygon_sheets", &T::polygon_sheets)
      .length("f")
      .doc("sheet of each polygon: polygons joined across edges of exactly two polygons");
  d.array("sheet_orientable", &T::sheet_orientable)
      .length("s")
      .doc("1 when the polygons of the sheet face one way, 0 when that is impossible");
  d.array("seams", &T::seams).length("m").doc("vertex pairs of edges of three and more polygons, ascending");
  d.array("seam_degrees", &T::seam_degrees).length("m").doc("polygons at each seam");
  d.array("seam_curves", &T::seam_curves)
      .length("m")
      .doc("curve of each seam: seams joined at vertices where exactly two end");
  d.summary("vertices", "number")
      .summary("edges", "edges that bound no polygon")
      .summary("polygons", "number");
  d.summary("euler_characteristic", "vertices - edges + polygons, every edge counted once");
  d.summary("components", "connected components");
  d.summary("sheets", "components of the polygons after cutting at seams");
  d.summary("sheets_not_orientable", "sheets with one side only");
  d.summary("seams", "edges of three and more polygons");
  d.summary("seam_curves", "curves that the seams form");
  d.summary("expected_euler_characteristic", "that of the alpha-shape the axis was made from");
  d.summarize([](const T& v) {
    const geometry::AxisTopology t = geometry::axis_topology(v);
    return Summary{
        {"vertices", v.vertices.size()},
        {"edges", v.edges.size()},
        {"polygons", v.polygons()},
        {"euler_characteristic", t.euler_characteristic},
        {"components", t.components},
        {"sheets", v.sheet_orientable.size()},
        {"sheets_not_orientable",
         std::count(v.sheet_orientable.begin(), v.sheet_orientable.end(), std::uint8_t{0})},
        {"seams", v.seams.size()},
        {"seam_curves",
         v.seam_curves.empty() ? 0 : *std::max_element(v.seam_curves.begin(), v.seam_curves.end()) + 1}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
