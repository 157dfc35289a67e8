#include "types/outline_comparison.hpp"

#include <array>

#include "types/planar_types.hpp"

namespace ballflow {

void TypeOf<geometry::OutlineComparison>::declare(TypeDecl<geometry::OutlineComparison>& d) {
  using T = geometry::OutlineComparison;
  d.id("OutlineComparison", 1).doc("How far two polygons are from each other: areas and distances.");
  d.scalar("area_a", &T::area_a).doc("area of a; -1: unknown, where rings cross or touch");
  d.scalar("area_b", &T::area_b).doc("area of b");
  d.scalar("only_a", &T::only_a).doc("area inside a and outside b");
  d.scalar("only_b", &T::only_b).doc("area inside b and outside a");
  d.scalar("a_to_b_at_least", &T::a_to_b_at_least)
      .doc("the largest distance of the boundary of a from that of b is not less");
  d.scalar("a_to_b_at_most", &T::a_to_b_at_most).doc("and not more");
  d.scalar("b_to_a_at_least", &T::b_to_a_at_least).doc("the same from b to a");
  d.scalar("b_to_a_at_most", &T::b_to_a_at_most).doc("and not more");
  d.summary("area_a", "squared model units; null where it is unknown")
      .summary("area_b", "squared model units");
  d.summary("only_a", "area inside a and outside b").summary("only_b", "area inside b and outside a");
  d.summary("symmetric_difference",
            "area inside one of them alone, as a part of that of a; null where a has none, or it is unknown");
  d.summary("a_to_b", "[at least, at most]: how far the boundary of a is from that of b, model units");
  d.summary("b_to_a", "[at least, at most]: the same from b to a");
  d.summarize([](const T& v) {
    const auto known = [&v](double x) { return v.areas_known() ? SummaryValue(x) : SummaryValue(nullptr); };
    return Summary{{"area_a", known(v.area_a)},
                   {"area_b", known(v.area_b)},
                   {"only_a", known(v.only_a)},
                   {"only_b", known(v.only_b)},
                   {"symmetric_difference",
                    v.area_a > 0 ? SummaryValue(v.symmetric_difference() / v.area_a) : SummaryValue(nullptr)},
                   {"a_to_b", std::array{v.a_to_b_at_least, v.a_to_b_at_most}},
                   {"b_to_a", std::array{v.b_to_a_at_least, v.b_to_a_at_most}}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
