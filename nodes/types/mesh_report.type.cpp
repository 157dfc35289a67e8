#include "types/mesh_report.hpp"

#include <string>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::MeshReport>::declare(TypeDecl<geometry::MeshReport>& d) {
  using T = geometry::MeshReport;
  d.id("MeshReport", 2).doc("How a mesh of the boundary of a union of balls was made, and what holds of it.");
  d.scalar("made_by", &T::made_by)
      .doc(
          "0 from the power diagram, 1 from that of balls whose radii were changed a little, 2 a grid, 3 a "
          "skin "
          "surface");
  d.scalar("vertices", &T::vertices).doc("vertices of the mesh");
  d.scalar("faces", &T::faces).doc("its triangles");
  d.scalar("components", &T::components).doc("its connected components");
  d.scalar("euler", &T::euler).doc("its Euler characteristic");
  d.scalar("surfaces", &T::surfaces).doc("components of the boundary of the union that was meshed");
  d.scalar("euler_given", &T::euler_given).doc("Euler characteristic of the union of the balls");
  d.scalar("euler_meshed", &T::euler_meshed).doc("that of the union that was meshed");
  d.scalar("closed", &T::closed).doc("1: every edge belongs to two triangles");
  d.scalar("manifold", &T::manifold).doc("1: every vertex star is a disk");
  d.scalar("oriented", &T::oriented).doc("1: neighbours run through their edge in opposite directions");
  d.scalar("error_asked", &T::error_asked).doc("model units");
  d.scalar("error", &T::error).doc("largest distance of the mesh from the boundary, model units");
  d.scalar("error_back", &T::error_back)
      .doc(
          "of a grid, skin surface or simplified mesh: largest distance of the boundary from the mesh, model "
          "units; -1: "
          "not measured");
  d.scalar("faces_before", &T::faces_before).doc("triangles before simplification; 0: there was none");
  d.scalar("growth", &T::growth).doc("most that a radius grew; below 0: shrank; model units");
  d.scalar("cell", &T::cell).doc("edge of a cell of the grid, model units; 0: no grid");
  d.scalar("rounds", &T::rounds).doc("how often arcs were divided again, or the grid was refined");
  d.scalar("self_intersections", &T::self_intersections)
      .doc("pairs of triangles that cross; -1: not counted");
  d.summary("made_by", "exact, exact of changed radii, grid, or skin surface")
      .summary("faces", "number of triangles");
  d.summary("components", "connected components of the mesh");
  d.summary("euler", "Euler characteristic of the mesh: twice that of the union");
  d.summary("euler_given", "Euler characteristic of the union of the balls");
  d.summary("euler_meshed", "that of the union that was meshed: other radii where they had to be changed");
  d.summary("differs", "what is not as it was asked for, in words; null when all is");
  d.summary("error_asked", "model units");
  d.summary("error", "the largest distance of the mesh from the boundary of the union, model units");
  d.summary("error_back",
            "the largest distance of the boundary from the mesh, in notches; null for exact meshes");
  d.summary("faces_before", "triangles before simplification; null where there was none");
  d.summary("growth", "the most that a radius grew, below 0 shrank, so that nothing is a tie; model units");
  d.summary("cell", "edge of a cell of the grid, model units; null without a grid");
  d.summary("self_intersections", "pairs of triangles that cross; null when they were not counted");
  d.summarize([](const T& v) {
    const std::string differs = geometry::what_differs(v);
    return Summary{
        {"made_by", std::string(geometry::in_words(static_cast<geometry::MeshedBy>(v.made_by)))},
        {"faces", v.faces},
        {"components", v.components},
        {"euler", v.euler},
        {"euler_given", v.euler_given},
        {"euler_meshed", v.euler_meshed},
        {"differs", differs.empty() ? SummaryValue(nullptr) : SummaryValue(differs)},
        {"error_asked", v.error_asked},
        {"error", v.error},
        {"error_back", v.error_back < 0 ? SummaryValue(nullptr) : SummaryValue(v.error_back)},
        {"faces_before", v.faces_before > 0 ? SummaryValue(v.faces_before) : SummaryValue(nullptr)},
        {"growth", v.growth},
        {"cell", v.cell > 0 ? SummaryValue(v.cell) : SummaryValue(nullptr)},
        {"self_intersections",
         v.self_intersections < 0 ? SummaryValue(nullptr) : SummaryValue(v.self_intersections)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
