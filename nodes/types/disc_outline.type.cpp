#include "types/disc_outline.hpp"

#include "types/box_summary.hpp"
#include "types/planar_types.hpp"

namespace ballflow {

void TypeOf<geometry::DiscOutline>::declare(TypeDecl<geometry::DiscOutline>& d) {
  using T = geometry::DiscOutline;
  d.id("DiscOutline", 1).doc("The boundary of a union of discs: rings of arcs, the union on the left.");
  d.array("centers", &T::centers).length("n").doc("of the discs that have an arc, model units");
  d.array("radii", &T::radii).length("n").doc("model units");
  d.array("discs", &T::discs).length("n").doc("their numbers among the discs whose union it is");
  d.array("arc_discs", &T::arc_discs).length("a").doc("the disc of each arc, an index into centers");
  d.array("arc_begins", &T::arc_begins)
      .length("a")
      .doc("where each arc begins; it ends where the next begins");
  d.array("arc_angles", &T::arc_angles).length("a").doc("how far it goes counter-clockwise, radians");
  d.array("ring_offsets", &T::ring_offsets).length("r+1").doc("where the arcs of a ring begin");
  d.array("component_offsets", &T::component_offsets)
      .length("c+1")
      .doc("where the rings of a component begin: the outer one, then holes");
  d.summary("arcs", "number of arcs").summary("components", "number of outer rings");
  d.summary("holes", "number of holes");
  d.summary("area", "of the union, squared model units").summary("perimeter", "of all rings, model units");
  d.summary("bbox", "bounding box in the plane z = 0, model units; null when it is empty");
  d.summarize([](const T& v) {
    return Summary{{"arcs", v.arc_discs.size()},          {"components", v.components()},
                   {"holes", v.rings() - v.components()}, {"area", geometry::area(v)},
                   {"perimeter", geometry::perimeter(v)}, {"bbox", box_summary(geometry::bounding_box(v))}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
