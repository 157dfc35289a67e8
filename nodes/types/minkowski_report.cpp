#include "types/minkowski_report.hpp"

#include <cmath>
#include <utility>

namespace ballflow::geometry {

std::string why_unbounded(ComparedWith a, ComparedWith b) {
  if (a == ComparedWith::nothing && b == ComparedWith::nothing) return "neither a nor b was compared";
  std::string text;
  for (const auto& [name, what] : {std::pair{"a", a}, std::pair{"b", b}}) {
    if (what == ComparedWith::nothing || what == ComparedWith::closed_mesh) continue;
    text += std::string(text.empty() ? "" : ", and ") + name + " was compared with " + in_words(what);
  }
  if (!text.empty()) text += ", which bounds no solid";
  return text;
}

std::string broken_invariant(const MinkowskiReport& r) {
  if (r.touching_boundary < 0) return "the number of balls on the boundary is negative";
  if (r.touching_boundary > r.count) return "more balls are on the boundary than contribute";
  if (r.count > r.survivors) return "more balls contribute than were triangulated";
  if (r.survivors > r.pairs) return "more balls were triangulated than there are pairs";
  if (r.count == 0 && r.pairs > 0) return "no ball contributes";
  if (!is_finite(r.lower) || !is_finite(r.upper)) return "the bounding box is not finite";
  if (!std::isfinite(r.error_bound)) return "the error bound is not finite";
  for (const std::uint8_t what : {r.a_compared_with, r.b_compared_with}) {
    if (what > static_cast<std::uint8_t>(ComparedWith::closed_mesh)) {
      return "a_compared_with or b_compared_with is above 3";
    }
  }
  const std::string why = why_unbounded(static_cast<ComparedWith>(r.a_compared_with),
                                        static_cast<ComparedWith>(r.b_compared_with));
  if (why.empty() != (r.error_bound >= 0)) {
    return why.empty() ? "there is no error bound, and no reason" : "there is an error bound, but " + why;
  }
  return {};
}

}  // namespace ballflow::geometry
