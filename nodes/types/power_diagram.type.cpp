#include <algorithm>

#include "types/power_diagram_type.hpp"

namespace ballflow {

void TypeOf<geometry::PowerDiagram>::declare(TypeDecl<geometry::PowerDiagram>& d) {
  using T = geometry::PowerDiagram;
  d.id("PowerDiagram", 1)
      .doc(
          "The regular triangulation of balls, dual to their power diagram, and which of its simplices are "
          "in "
          "the dual complex of the union.");
  d.array("centers", &T::centers).length("n").doc("centres of the balls, model units");
  d.array("weights", &T::weights).length("n").doc("squared radii, delta included");
  d.array("cells", &T::cells)
      .length("c")
      .doc(
          "vertices of each cell: balls, -1 for the vertex at infinity, -2 where there are fewer than four; "
          "positively oriented, in lexicographic order of their ascending vertices");
  d.array("neighbors", &T::neighbors).length("c").doc("the cell opposite each vertex");
  d.array("in_complex", &T::in_complex)
      .length("c")
      .doc("bit 4: the cell is in the complex; bit k: its facet opposite vertex k is");
  d.scalar("dimension", &T::dimension).doc("of the affine hull of the centres; -1 without balls");
  d.scalar("delta", &T::delta).doc("added to every squared radius before anything was decided");
  d.summary("balls", "number of balls").summary("hidden", "balls without a power cell");
  d.summary("dimension", "of the affine hull of the centres; -1 without balls");
  d.summary("cells", "finite cells of the triangulation");
  d.summary("infinite_cells", "cells that close it to a sphere");
  d.summary("cells_in_complex", "cells in the dual complex of the union");
  d.summary("delta", "squared model units");
  d.summarize([](const T& v) {
    std::int64_t infinite = 0, inside = 0;
    std::vector<bool> seen(v.centers.size());
    for (std::size_t c = 0; c < v.size(); ++c) {
      bool finite = true;
      for (const std::int32_t ball : v.cells[c]) {
        finite = finite && ball != T::infinite;
        if (ball >= 0) seen[static_cast<std::size_t>(ball)] = true;
      }
      infinite += finite ? 0 : 1;
      inside += (v.in_complex[c] & T::whole) != 0 ? 1 : 0;
    }
    return Summary{{"balls", v.centers.size()},
                   {"hidden", std::count(seen.begin(), seen.end(), false)},
                   {"dimension", v.dimension},
                   {"cells", static_cast<std::int64_t>(v.size()) - infinite},
                   {"infinite_cells", infinite},
                   {"cells_in_complex", inside},
                   {"delta", v.delta}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
