#include "types/ball_distance.hpp"

#include <array>
#include <string>

#include "types/motion_types.hpp"

namespace ballflow {

void TypeOf<geometry::BallDistance>::declare(TypeDecl<geometry::BallDistance>& d) {
  using T = geometry::BallDistance;
  d.id("BallDistance", 1).doc("How far two sets of balls are apart: witnesses, near pairs, clearances.");
  d.scalar("balls_a", &T::balls_a).doc("number of balls of a");
  d.scalar("balls_b", &T::balls_b).doc("number of balls of b");
  d.scalar("a", &T::a).doc("ball of a in the pair with the smallest separation");
  d.scalar("b", &T::b).doc("ball of b in that pair");
  d.scalar("separation", &T::separation).doc("of that pair: |c - c'| - r - r', model units");
  d.scalar("point_a", &T::point_a).doc("on its sphere of a, next to b or deepest in it, model units");
  d.scalar("point_b", &T::point_b).doc("on its sphere of b");
  d.scalar("threshold", &T::threshold).doc("pairs with at most this separation are listed, model units");
  d.scalar("cut", &T::cut).doc("1 where there are more pairs than are listed");
  d.array("pairs", &T::pairs).length("p").doc("ball of a, ball of b; ascending by separation, a, b");
  d.array("separations", &T::separations).length("p").doc("of the pairs, model units");
  d.array("pair_points_a", &T::pair_points_a).length("p").doc("as point_a, of the pairs");
  d.array("pair_points_b", &T::pair_points_b).length("p").doc("as point_b, of the pairs");
  d.array("centers_a", &T::centers_a).length("n").optional().doc("the balls of a, model units");
  d.array("radii_a", &T::radii_a).length("n").optional().doc("model units");
  d.array("clearances_a", &T::clearances_a)
      .length("n")
      .optional()
      .doc("separation from the nearest ball of b");
  d.array("nearest_a", &T::nearest_a).length("n").optional().doc("that ball");
  d.array("centers_b", &T::centers_b).length("m").optional().doc("the balls of b, model units");
  d.array("radii_b", &T::radii_b).length("m").optional().doc("model units");
  d.array("clearances_b", &T::clearances_b)
      .length("m")
      .optional()
      .doc("separation from the nearest ball of a");
  d.array("nearest_b", &T::nearest_b).length("m").optional().doc("that ball");
  d.scalar("solids_at_least", &T::solids_at_least).doc("the solids are so far apart: proven; model units");
  d.scalar("solids_at_most", &T::solids_at_most).doc("and no farther; -1: unknown");
  d.scalar("a_solid", &T::a_solid)
      .doc("the balls of a: 0 are the solid, 1 enclose it, 2 are near it, 3 nothing is known");
  d.scalar("b_solid", &T::b_solid).doc("the same of b");
  d.summary("separation", "smallest |c - c'| - r - r' of all pairs, model units; negative: they overlap");
  d.summary("balls", "[of a, of b] with this separation")
      .summary("points", "[on a, on b]: where, model units");
  d.summary("pairs", "number of pairs that are listed").summary("threshold", "their largest separation");
  d.summary("cut", "whether there are more pairs than are listed");
  d.summary("solids", "[at least, at most]: the distance of the solids, model units: proven; null: unknown");
  d.summary("words", "the distance in words")
      .summary("solids_words", "what is proven about the solids; or null");
  d.summarize([](const T& v) {
    const std::string solids = geometry::describe_solids(v);
    const auto at = [](const geometry::Vec3& p) { return std::array{p.x, p.y, p.z}; };
    return Summary{
        {"separation", v.separation},
        {"balls", std::array<std::int64_t, 2>{v.a, v.b}},
        {"points", std::array<std::array<double, 3>, 2>{at(v.point_a), at(v.point_b)}},
        {"pairs", static_cast<std::int64_t>(v.pairs.size())},
        {"threshold", v.threshold},
        {"cut", v.cut != 0},
        {"solids", v.solids_at_most < 0 ? SummaryValue(nullptr)
                                        : SummaryValue(std::array{v.solids_at_least, v.solids_at_most})},
        {"words", geometry::describe(v)},
        {"solids_words", solids.empty() ? SummaryValue(nullptr) : SummaryValue(solids)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
