#include "types/mass_properties.hpp"

#include <array>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::MassProperties>::declare(TypeDecl<geometry::MassProperties>& d) {
  using T = geometry::MassProperties;
  d.id("MassProperties", 1)
      .doc("What a solid of density 1 weighs and how it turns, in powers of model units.");
  d.scalar("volume", &T::volume).doc("volume");
  d.scalar("area", &T::area).doc("area of the boundary");
  d.scalar("center_of_mass", &T::center_of_mass).doc("centre of mass");
  d.scalar("inertia", &T::inertia).doc("inertia tensor about the centre of mass: xx, yy, zz, xy, xz, yz");
  d.scalar("closure_error", &T::closure_error)
      .doc("length of the integral of the outward normal, divided by the area: 0 but for rounding");
  d.summary("volume", "cubed model units").summary("area", "of the boundary, squared model units");
  d.summary("center_of_mass", "[x, y, z], model units");
  d.summary("inertia", "[xx, yy, zz, xy, xz, yz] about the centre of mass at density 1");
  d.summary("closure_error", "0 but for rounding");
  d.summarize([](const T& v) {
    const geometry::Vec3 c = v.center_of_mass;
    return Summary{{"volume", v.volume},
                   {"area", v.area},
                   {"center_of_mass", std::array{c.x, c.y, c.z}},
                   {"inertia", v.inertia},
                   {"closure_error", v.closure_error}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
