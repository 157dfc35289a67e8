#include "types/surface_report.hpp"

#include <algorithm>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::SurfaceReport>::declare(TypeDecl<geometry::SurfaceReport>& d) {
  using T = geometry::SurfaceReport;
  d.id("SurfaceReport", 1).doc("How a surface was found among the cells of a triangulation.");
  d.scalar("components", &T::components).doc("connected components");
  d.scalar("genus", &T::genus).doc("of all components together");
  d.scalar("overruled", &T::overruled).doc("share of the weight of the poles' votes that it contradicts");
  d.scalar("filled_area", &T::filled_area).doc("share of the area that closes holes");
  d.scalar("mixed_voids", &T::mixed_voids).doc("parts of space with votes for both sides");
  d.scalar("split_vertices", &T::split_vertices).doc("copies of vertices where sheets touch");
  d.scalar("midpoints", &T::midpoints).doc("vertices that are no samples");
  d.scalar("specks", &T::specks).doc("small components that were left out");
  d.array("vertex_balls", &T::vertex_balls).length("n").doc("ball of each vertex, -1 for midpoints");
  d.array("filled", &T::filled).length("m").doc("1 for triangles that close a hole");
  d.summary("components", "connected components").summary("genus", "of all components together");
  d.summary("overruled", "share of the weight of the poles' votes that the surface contradicts");
  d.summary("filled_area", "share of the area that closes holes");
  d.summary("filled", "triangles that close holes");
  d.summary("mixed_voids", "parts of space with votes for both sides, which were cut");
  d.summary("split_vertices", "copies of vertices where sheets touch");
  d.summary("midpoints", "vertices that are no samples");
  d.summary("specks", "small components that were left out");
  d.summarize([](const T& v) {
    return Summary{{"components", v.components},
                   {"genus", v.genus},
                   {"overruled", v.overruled},
                   {"filled_area", v.filled_area},
                   {"filled", static_cast<std::int64_t>(std::count(v.filled.begin(), v.filled.end(), 1))},
                   {"mixed_voids", v.mixed_voids},
                   {"split_vertices", v.split_vertices},
                   {"midpoints", v.midpoints},
                   {"specks", v.specks}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
