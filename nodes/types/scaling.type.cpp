#include "types/scaling.hpp"

#include <array>

#include "types/ellipsoid_types.hpp"

namespace ballflow {

void TypeOf<geometry::Scaling>::declare(TypeDecl<geometry::Scaling>& d) {
  using T = geometry::Scaling;
  d.id("Scaling", 1).doc("A map that stretches an object along three perpendicular axes.");
  d.scalar("origin", &T::origin).doc("what is mapped to the origin, model units");
  d.scalar("rotation", &T::rotation)
      .doc("unit quaternion w x y z: from the axes of the coordinates to the three axes");
  d.scalar("factors", &T::factors).doc("along the axes, at least 1; the least is 1");
  d.scalar("thickness", &T::thickness)
      .doc("of the object along the axes, model units; 0 where factors were given");
  d.scalar("longest_edge", &T::longest_edge).doc("of the object's box along the coordinates, model units");
  d.scalar("thickness_from", &T::thickness_from).doc("0 mean chords, 1 extents, 2 factors were given");
  d.summary("factors", "along the three axes").summary("thickness", "along the three axes, model units");
  d.summary("largest_factor", "1: nothing is stretched")
      .summary("words", "the factors, and what they are from");
  d.summarize([](const T& v) {
    return Summary{{"factors", std::array<double, 3>{v.factors.x, v.factors.y, v.factors.z}},
                   {"thickness", std::array<double, 3>{v.thickness.x, v.thickness.y, v.thickness.z}},
                   {"largest_factor", v.largest_factor()},
                   {"words", geometry::describe(v)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
