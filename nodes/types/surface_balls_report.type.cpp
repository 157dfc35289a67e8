#include "types/surface_types.hpp"

namespace ballflow {

void TypeOf<geometry::SurfaceBallsReport>::declare(TypeDecl<geometry::SurfaceBallsReport>& d) {
  using T = geometry::SurfaceBallsReport;
  d.id("SurfaceBallsReport", 1)
      .doc("How large surface balls are, and on which ground their union has the topology of the surface.");
  d.scalar("radius", &T::radius).doc("rho, times the distance to the nearest pole");
  d.scalar("shrink", &T::shrink).doc("rho_bar, times the same, of the copies that have to cover the samples");
  d.scalar("regime", &T::regime).doc("0 proven, 1 supported, 2 heuristic");
  d.scalar("samples", &T::samples).doc("number of samples");
  d.scalar("raised", &T::raised).doc("balls that a floor made larger than rho D^");
  d.scalar("coarse", &T::coarse).doc("samples whose third neighbour is farther than 0.8 D^");
  d.summary("radius", "rho, times the distance to the nearest pole");
  d.summary("shrink", "rho_bar, of the copies that have to cover the samples");
  d.summary("regime",
            "why the union has the topology of the surface: \"proven\" (Theorem 4.14), \"supported\" (by the "
            "thesis' experiments) or \"heuristic\"");
  d.summary("samples", "number of samples").summary("raised", "balls that a floor made larger than rho D^");
  d.summary("coarse", "samples whose third neighbour is about as far as the medial axis, or farther");
  d.summarize([](const T& v) {
    return Summary{{"radius", v.radius},
                   {"shrink", v.shrink},
                   {"regime", geometry::name(static_cast<geometry::SurfaceRegime>(v.regime))},
                   {"samples", v.samples},
                   {"raised", v.raised},
                   {"coarse", v.coarse}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
