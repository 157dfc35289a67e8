#include "types/cover_check.hpp"

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::CoverCheck>::declare(TypeDecl<geometry::CoverCheck>& d) {
  using T = geometry::CoverCheck;
  d.id("CoverCheck", 2).doc("The outcome of checking from geometry that balls cover samples.");
  d.scalar("balls", &T::balls).doc("number of balls");
  d.scalar("samples", &T::samples).doc("number of samples");
  d.array("uncovered", &T::uncovered).length("u").doc("samples in no ball, ascending");
  d.scalar("certified_bound", &T::certified_bound)
      .doc("no cover has fewer balls: a checked certificate proves it; -1 without one");
  d.summary("certified_bound", "the same, null without a certificate");
  d.summary("balls", "number of balls").summary("samples", "number of samples");
  d.summary("covered", "samples in at least one ball").summary("uncovered", "samples in none");
  d.summarize([](const T& v) {
    const auto missing = static_cast<std::int64_t>(v.uncovered.size());
    return Summary{
        {"balls", v.balls},
        {"samples", v.samples},
        {"covered", v.samples - missing},
        {"uncovered", missing},
        {"certified_bound", v.certified_bound < 0 ? SummaryValue(nullptr) : SummaryValue(v.certified_bound)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
