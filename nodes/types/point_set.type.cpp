#include "types/point_set.hpp"

#include "types/box_summary.hpp"
#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::PointSet>::declare(TypeDecl<geometry::PointSet>& d) {
  using T = geometry::PointSet;
  d.id("PointSet", 1).doc("A sample of a surface: n pairwise distinct points.");
  d.array("points", &T::points).length("n").doc("coordinates, model units");
  d.array("normals", &T::normals).length("n").optional().doc("unit normals, where the source had them");
  d.summary("count", "number of points").summary("bbox", "[[min x, y, z], [max x, y, z]], model units");
  d.summarize([](const T& v) {
    return Summary{{"count", v.points.size()},
                   {"bbox", box_summary(geometry::bounding_box(v.points.span()))}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
