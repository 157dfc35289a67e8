#include "types/refinement.hpp"

#include <algorithm>
#include <array>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::Refinement>::declare(TypeDecl<geometry::Refinement>& d) {
  using T = geometry::Refinement;
  d.id("Refinement", 1).doc("What became of the refinement of a sample, and where it could not go on.");
  d.scalar("refined", &T::refined).doc("1, or 0 where the points that came in were returned");
  d.scalar("complete", &T::complete).doc("0 where the greatest number of samples stopped it");
  d.scalar("left_out", &T::left_out).doc("triangles with the inside on both sides, which were left out");
  d.scalar("samples", &T::samples).doc("number of samples");
  d.scalar("rounds", &T::rounds).doc("rounds of insertions");
  d.array("limited", &T::limited).length("l").doc("where balls are below the floor, model units");
  d.array("widths", &T::widths).length("l").doc("width of the wall or slot there, model units");
  d.array("uncovered", &T::uncovered).length("u").doc("samples that no inner ball passes through");
  d.scalar("wanted", &T::wanted).doc("components, tunnels, cavities of the solid; -1 if unknown");
  d.scalar("cells", &T::cells).doc("those of the inner Delaunay cells; -1 where they bound no surface");
  d.scalar("balls", &T::balls).doc("those of the union of the inner balls");
  d.summary("refined", "whether samples were chosen, or the points that came in were returned");
  d.summary("complete", "false where the greatest number of samples stopped it");
  d.summary("left_out", "triangles with the inside on both sides, which were left out");
  d.summary("samples", "number of samples").summary("rounds", "rounds of insertions");
  d.summary("limited", "balls below the floor that reach deep into a wall or slot");
  d.summary("thinnest", "width of the thinnest such wall or slot, model units; null without one");
  d.summary("uncovered", "samples that no inner ball passes through");
  d.summary("wanted", "[components, tunnels, cavities] of the solid; null when not known");
  d.summary("cells", "those of the inner Delaunay cells; null where they bound no surface");
  d.summary("balls", "those of the union of the inner balls; null where nothing was refined");
  d.summary("reached", "whether the union of the inner balls has the topology it should have");
  d.summarize([](const T& v) {
    const auto betti = [](const std::array<std::int64_t, 3>& b) {
      return b == T::unknown ? SummaryValue(nullptr) : SummaryValue(b);
    };
    const auto thinnest = std::min_element(v.widths.begin(), v.widths.end());
    return Summary{{"refined", v.refined == 1},
                   {"complete", v.complete == 1},
                   {"left_out", v.left_out},
                   {"samples", v.samples},
                   {"rounds", v.rounds},
                   {"limited", v.limited.size()},
                   {"thinnest", thinnest == v.widths.end() ? SummaryValue(nullptr) : SummaryValue(*thinnest)},
                   {"uncovered", v.uncovered.size()},
                   {"wanted", betti(v.wanted)},
                   {"cells", betti(v.cells)},
                   {"balls", betti(v.balls)},
                   {"reached", v.reached()}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
