#include "types/minkowski_report.hpp"

#include <string>

#include "types/box_summary.hpp"
#include "types/type_of.hpp"

namespace ballflow {
namespace {

SummaryValue words_or_null(const std::string& words) {
  return words.empty() ? SummaryValue(nullptr) : SummaryValue(words);
}

}  // namespace

void TypeOf<geometry::MinkowskiReport>::declare(TypeDecl<geometry::MinkowskiReport>& d) {
  using T = geometry::MinkowskiReport;
  d.id("MinkowskiReport", 4).doc("What the Minkowski sum of two sets of balls came to.");
  d.scalar("pairs", &T::pairs).doc("pairs of balls");
  d.scalar("survivors", &T::survivors)
      .doc("sums of pairs that were triangulated; of algorithm memory: that were vertices at the end");
  d.scalar("count", &T::count).doc("balls of the result: the sums that contribute, or the smallest part");
  d.scalar("contributing", &T::contributing).doc("sums that contribute");
  d.scalar("minimal", &T::minimal)
      .doc("sums in the smallest part of these with the same union; -1: nobody asked for it");
  d.scalar("touching_boundary", &T::touching_boundary)
      .doc("contributing sums on the boundary of the union, all of which are needed");
  d.scalar("lower", &T::lower).doc("corner of the bounding box of the union, model units");
  d.scalar("upper", &T::upper).doc("the opposite corner");
  d.scalar("error_bound", &T::error_bound)
      .doc("no point of the surface of the sum of the solids is farther from the union; -1: unknown");
  d.scalar("a_compared_with", &T::a_compared_with)
      .doc("the solid a: 0 its balls, 1 points, 2 an open mesh, 3 a closed mesh, or polygons");
  d.scalar("b_compared_with", &T::b_compared_with).doc("the same of b");
  d.scalar("excess_bound", &T::excess_bound)
      .doc("no point of the union is farther from the sum of the solids; -1: unknown");
  d.scalar("rounded", &T::rounded).doc("sums are rounded 0 to nearest, 1 inwards, 2 outwards");
  d.scalar("a_encloses", &T::a_encloses)
      .doc("the solid a lies in its balls: 0 not known, 1 proven, 2 not so, 3 it is its balls");
  d.scalar("b_encloses", &T::b_encloses).doc("the same of b");
  d.scalar("a_inside", &T::a_inside).doc("no ball reaches out of the solid a: as before");
  d.scalar("b_inside", &T::b_inside).doc("the same of b");
  d.summary("pairs", "pairs of balls").summary("survivors", "sums of pairs that were triangulated");
  d.summary("count", "balls of the result: the sums that contribute, or the smallest part of them");
  d.summary("contributing", "sums that contribute to the union");
  d.summary("minimal",
            "sums in an inclusion-minimal part of these with the same union; null when nobody asked for it");
  d.summary("touching_boundary", "sums with a piece of their sphere on the boundary of the union: needed");
  d.summary("bbox", "bounding box of the union, model units; null when it is empty");
  d.summary(
      "error_bound",
      "no point of the surface of the sum of the solids is farther from the union, model units; null when "
      "it is unknown");
  d.summary("excess_bound",
            "no point of the union is farther from the sum of the solids, model units; null when it is "
            "unknown");
  d.summary("proven", "contains A + B, or lies inside A + B, and how that is proven; null when neither is");
  d.summary("not_proven", "why neither is");
  d.summary("error_bound_unknown", "why there is no error bound: no comparison, or one with no closed mesh");
  d.summarize([](const T& v) {
    geometry::Box box;
    if (v.count > 0) box = {v.lower, v.upper};
    const std::string why = geometry::why_unbounded(static_cast<geometry::ComparedWith>(v.a_compared_with),
                                                    static_cast<geometry::ComparedWith>(v.b_compared_with));
    return Summary{
        {"pairs", v.pairs},
        {"survivors", v.survivors},
        {"count", v.count},
        {"contributing", v.contributing},
        {"minimal", v.minimal < 0 ? SummaryValue(nullptr) : SummaryValue(v.minimal)},
        {"touching_boundary", v.touching_boundary},
        {"bbox", box_summary(box)},
        {"error_bound", v.error_bound < 0 ? SummaryValue(nullptr) : SummaryValue(v.error_bound)},
        {"excess_bound", v.excess_bound < 0 ? SummaryValue(nullptr) : SummaryValue(v.excess_bound)},
        {"proven", words_or_null(geometry::proven_statement(v))},
        {"not_proven", words_or_null(geometry::why_not_one_sided(v))},
        {"error_bound_unknown", words_or_null(why)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
