#include "types/polygon2.hpp"

#include "types/box_summary.hpp"
#include "types/planar_types.hpp"

namespace ballflow {

void TypeOf<geometry::Polygon2>::declare(TypeDecl<geometry::Polygon2>& d) {
  using T = geometry::Polygon2;
  d.id("Polygon2", 1).doc("Polygons in the plane: components with holes, the inside on the left.");
  d.array("vertices", &T::vertices).length("n").doc("coordinates, model units, y upwards");
  d.array("ring_offsets", &T::ring_offsets).length("r+1").doc("where the vertices of a ring begin");
  d.array("component_offsets", &T::component_offsets)
      .length("c+1")
      .doc("where the rings of a component begin: the outer one, counter-clockwise, then holes, clockwise");
  d.summary("vertices", "number of vertices").summary("components", "number of outer rings");
  d.summary("holes", "number of holes");
  d.summary("area", "of the inside, squared model units").summary("perimeter", "of all rings, model units");
  d.summary("bbox", "bounding box in the plane z = 0, model units; null when it is empty");
  d.summarize([](const T& v) {
    return Summary{{"vertices", v.vertices.size()},       {"components", v.components()},
                   {"holes", v.rings() - v.components()}, {"area", geometry::area(v)},
                   {"perimeter", geometry::perimeter(v)}, {"bbox", box_summary(geometry::bounding_box(v))}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
