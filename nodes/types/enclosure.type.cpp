#include "types/enclosure_type.hpp"

namespace ballflow {

void TypeOf<geometry::Enclosure>::declare(TypeDecl<geometry::Enclosure>& d) {
  using T = geometry::Enclosure;
  d.id("Enclosure", 3).doc("Whether a union of balls contains everything inside a surface.");
  d.scalar("balls", &T::balls).doc("number of balls");
  d.scalar("triangles", &T::triangles).doc("triangles of the mesh");
  d.scalar("pieces", &T::pieces).doc("parts of the triangles that lie in one ball each");
  d.scalar("meant", &T::meant).doc("0 where the balls are not meant to enclose");
  d.scalar("closed", &T::closed).doc("1 where the mesh is closed, so that it has a solid inside");
  d.array("open_triangles", &T::open_triangles).length("u").doc("triangles not proven to be covered");
  d.array("open_points", &T::open_points).length("u").doc("a point of each, model units");
  d.array("open_why", &T::open_why)
      .length("u")
      .doc("0 the point is in no ball, 1 balls meet there without overlap");
  d.scalar("area", &T::area).doc("of the triangles, squared model units");
  d.scalar("open_area", &T::open_area).doc("about how much of it is in no ball");
  d.scalar("gap", &T::gap).doc("farthest of the looked-at points of the mesh from the balls, model units");
  d.scalar("gap_at_most", &T::gap_at_most)
      .doc("no point of the mesh is farther from the balls, model units; -1: not known");
  d.array("void_points", &T::void_points).length("v").doc("a point in every void of the union");
  d.array("void_places", &T::void_places).length("v").doc("0 outside the solid, 1 inside, 2 not known");
  d.scalar("protrusion", &T::protrusion)
      .doc("no point of the balls is farther from the solid, or from an open mesh; model units");
  d.summary("encloses", "everything that the mesh separates from infinity is in the balls: proven");
  d.summary("meant", "whether the balls are meant to enclose");
  d.summary("words", "the same in words, or what is not").summary("balls", "number of balls");
  d.summary("triangles", "triangles of the mesh").summary("open_triangles", "those not proven to be covered");
  d.summary("open_share", "about which part of the surface is in no ball");
  d.summary("gap", "farthest point of the mesh from the balls that was met, model units");
  d.summary("gap_at_most",
            "no point of the mesh is farther from the balls, model units; null without balls or triangles");
  d.summary("voids", "voids inside the solid").summary("closed", "whether the mesh is closed");
  d.summary("protrusion", "no point of the balls is farther from the solid; model units");
  d.summary("pieces", "parts of the triangles that lie in one ball each");
  d.summarize([](const T& v) {
    return Summary{{"encloses", v.encloses()},
                   {"meant", v.meant != 0},
                   {"words", geometry::describe(v)},
                   {"balls", v.balls},
                   {"triangles", v.triangles},
                   {"open_triangles", static_cast<std::int64_t>(v.open_triangles.size())},
                   {"open_share", v.area > 0 ? v.open_area / v.area : 0.0},
                   {"gap", v.gap},
                   {"gap_at_most", v.gap_at_most < 0 ? SummaryValue(nullptr) : SummaryValue(v.gap_at_most)},
                   {"voids", v.voids_that_matter()},
                   {"closed", v.closed != 0},
                   {"protrusion", v.protrusion},
                   {"pieces", v.pieces}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
