#include "types/path.hpp"

#include "types/box_summary.hpp"
#include "types/motion_types.hpp"

namespace ballflow {

void TypeOf<geometry::Path>::declare(TypeDecl<geometry::Path>& d) {
  using T = geometry::Path;
  d.id("Path", 1).doc("A polyline with a radius at every point: what something moves along.");
  d.array("points", &T::points).length("n").doc("joined by straight segments, model units");
  d.array("radii", &T::radii).length("n").doc("of the path at each, linear in between, model units");
  d.scalar("balls", &T::balls).doc("number of balls that were made of it");
  d.scalar("spacing", &T::spacing).doc("their centers are no farther apart along the path, model units");
  d.scalar("contains", &T::contains).doc("1 where the balls contain the path, 0 where they lie in it");
  d.scalar("error", &T::error).doc("no point of balls or path is farther from the other, model units");
  d.summary("points", "number of points").summary("length", "of all segments, model units");
  d.summary("bbox", "bounding box of the points, model units").summary("balls", "number of balls made of it");
  d.summary("spacing", "their centers are no farther apart, model units");
  d.summary("contains", "whether the balls contain the path, or lie in it");
  d.summary("error", "no point of balls or path is farther from the other, model units");
  d.summarize([](const T& v) {
    return Summary{{"points", static_cast<std::int64_t>(v.size())},
                   {"length", geometry::length(v)},
                   {"bbox", box_summary(geometry::bounding_box(v.points.span()))},
                   {"balls", v.balls},
                   {"spacing", v.spacing},
                   {"contains", v.contains != 0},
                   {"error", v.error}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
