#include "types/surface_report.hpp"

#include <algorithm>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::SurfaceReport>::declare(TypeDecl<geometry::SurfaceReport>& d) {
  using T = geometry::SurfaceReport;
  d.id("SurfaceReport", 3).doc("How a surface was found among the cells of a triangulation.");
  d.scalar("components", &T::components).doc("connected components");
  d.scalar("genus", &T::genus).doc("of all components together");
  d.scalar("boundary_loops", &T::boundary_loops).doc("0 for a closed surface");
  d.scalar("overruled", &T::overruled).doc("share of the weight of the poles' votes that it contradicts");
  d.scalar("filled_area", &T::filled_area).doc("share of the area that closes holes");
  d.scalar("wide_area", &T::wide_area).doc("share of the area that closes gaps wider than the balls");
  d.scalar("left_out", &T::left_out).doc("balls that the surface passes by, farther than their radius");
  d.scalar("left_out_area", &T::left_out_area).doc("their share of the squared radii of all");
  d.scalar("farthest", &T::farthest).doc("how far the farthest of them is, model units");
  d.scalar("left_out_patch", &T::left_out_patch)
      .doc("the most of them that hang together, by balls that meet");
  d.scalar("patch_at", &T::patch_at).doc("the centre of the farthest of these, model units");
  d.scalar("mixed_voids", &T::mixed_voids).doc("parts of space with votes for both sides");
  d.scalar("split_vertices", &T::split_vertices).doc("copies of vertices where sheets touch");
  d.scalar("midpoints", &T::midpoints).doc("vertices that are no samples");
  d.scalar("specks", &T::specks).doc("small components that were left out");
  d.array("vertex_balls", &T::vertex_balls).length("n").doc("ball of each vertex, -1 for midpoints");
  d.array("filled", &T::filled).length("m").doc("1 for triangles that close a gap, 2 for a wide one");
  d.array("contradicted", &T::contradicted)
      .length("m")
      .doc("1 for triangles beside which poles say the contrary");
  d.array("vertices", &T::vertices).length("n").doc("of the surface, model units");
  d.array("triangles", &T::triangles).length("m").doc("of the surface");
  d.summary("components", "connected components").summary("genus", "of all components together");
  d.summary("overruled", "share of the weight of the poles' votes that the surface contradicts");
  d.summary("boundary_loops", "0 for a closed surface");
  d.summary("filled_area", "share of the area that closes gaps between balls");
  d.summary("filled", "triangles that close them");
  d.summary("wide_area", "share of the area that closes gaps wider than the balls around them: holes");
  d.summary("left_out", "kept samples that the surface passes by, farther than their ball");
  d.summary("left_out_area", "their share of the squared radii of all balls");
  d.summary("farthest", "how far the farthest of them is, model units");
  d.summary("left_out_patch",
            "the most of them that hang together: from ten on a part of the shape, not noise");
  d.summary("mixed_voids", "parts of space with votes for both sides, which were cut");
  d.summary("split_vertices", "copies of vertices where sheets touch");
  d.summary("midpoints", "vertices that are no samples");
  d.summary("specks", "small components that were left out");
  d.summarize([](const T& v) {
    return Summary{{"components", v.components},
                   {"genus", v.genus},
                   {"boundary_loops", v.boundary_loops},
                   {"overruled", v.overruled},
                   {"filled_area", v.filled_area},
                   {"filled", static_cast<std::int64_t>(v.filled.size()) -
                                  std::count(v.filled.begin(), v.filled.end(), 0)},
                   {"wide_area", v.wide_area},
                   {"left_out", v.left_out},
                   {"left_out_area", v.left_out_area},
                   {"farthest", v.farthest},
                   {"left_out_patch", v.left_out_patch},
                   {"mixed_voids", v.mixed_voids},
                   {"split_vertices", v.split_vertices},
                   {"midpoints", v.midpoints},
                   {"specks", v.specks}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
