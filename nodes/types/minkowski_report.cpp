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

namespace {

bool holds(std::uint8_t proof) {
  return proof == static_cast<std::uint8_t>(SideProof::proven) ||
         proof == static_cast<std::uint8_t>(SideProof::itself);
}

bool both_are_themselves(const MinkowskiReport& r) {
  const auto itself = static_cast<std::uint8_t>(SideProof::itself);
  return r.a_encloses == itself && r.b_encloses == itself;
}

bool rounded(const MinkowskiReport& r, SumsRounded how) {
  return r.rounded == static_cast<std::uint8_t>(how);
}

/// "a", "b", "a and b", of those for which something is not proven.
std::string open_sides(std::uint8_t a, std::uint8_t b, SideProof why) {
  const auto code = static_cast<std::uint8_t>(why);
  if (a == code && b == code) return "a and b";
  return a == code ? "a" : b == code ? "b" : "";
}

std::string why_not(std::uint8_t a, std::uint8_t b, const char* unknown, const char* refuted) {
  std::string text;
  for (const auto& [why, words] :
       {std::pair{SideProof::refuted, refuted}, std::pair{SideProof::unknown, unknown}}) {
    const std::string sides = open_sides(a, b, why);
    if (!sides.empty()) text += (text.empty() ? "" : "; ") + std::string(words) + sides;
  }
  return text;
}

}  // namespace

bool MinkowskiReport::contains() const {
  return rounded == static_cast<std::uint8_t>(SumsRounded::outwards) && holds(a_encloses) &&
         holds(b_encloses) && !both_are_themselves(*this);
}

bool MinkowskiReport::inside() const {
  return rounded == static_cast<std::uint8_t>(SumsRounded::inwards) && holds(a_inside) && holds(b_inside) &&
         !both_are_themselves(*this);
}

std::string proven_statement(const MinkowskiReport& r) {
  if (r.contains())
    return "contains A + B: each solid lies in its balls (every triangle does, and they leave no void), and "
           "sums are rounded outwards";
  if (r.inside())
    return "lies inside A + B: no ball reaches out of its solid (none is larger than its distance from the "
           "surface), and sums are rounded inwards";
  return {};
}

std::string why_not_one_sided(const MinkowskiReport& r) {
  if (r.contains() || r.inside()) return {};
  if (both_are_themselves(r)) return "neither a nor b was compared with a solid";
  if (rounded(r, SumsRounded::outwards))
    return why_not(r.a_encloses, r.b_encloses, "there is no proof that balls enclose ",
                   "balls do not enclose ");
  if (rounded(r, SumsRounded::inwards))
    return why_not(r.a_inside, r.b_inside,
                   "there is no closed surface for balls to be inside of: ", "balls reach out of ");
  return "mode balanced leaves either side open";
}

std::string broken_invariant(const MinkowskiReport& r) {
  if (r.touching_boundary < 0) return "the number of balls on the boundary is negative";
  if (r.touching_boundary > r.count) return "more balls are on the boundary than are kept";
  if (r.minimal < -1) return "the number of balls that are needed is below -1";
  if (r.count != (r.minimal < 0 ? r.contributing : r.minimal))
    return "the balls of the result are neither those that contribute nor those that are needed";
  if (r.count > r.contributing) return "more balls are kept than contribute";
  if (r.contributing > r.survivors) return "more balls contribute than were triangulated";
  if (r.survivors > r.pairs) return "more balls were triangulated than there are pairs";
  if (r.count == 0 && r.pairs > 0) return "no ball contributes";
  if (!is_finite(r.lower) || !is_finite(r.upper)) return "the bounding box is not finite";
  if (!std::isfinite(r.error_bound)) return "the error bound is not finite";
  for (const std::uint8_t what : {r.a_compared_with, r.b_compared_with}) {
    if (what > static_cast<std::uint8_t>(ComparedWith::closed_mesh)) {
      return "a_compared_with or b_compared_with is above 3";
    }
  }
  if (!std::isfinite(r.excess_bound)) return "the bound of the excess is not finite";
  if (r.rounded > static_cast<std::uint8_t>(SumsRounded::outwards)) return "rounded is above 2";
  for (const std::uint8_t proof : {r.a_encloses, r.b_encloses, r.a_inside, r.b_inside}) {
    if (proof > static_cast<std::uint8_t>(SideProof::itself))
      return "a_encloses, b_encloses, a_inside or b_inside is above 3";
  }
  if (r.contains() && r.error_bound > 0) return "what contains the sum has an error bound above 0";
  if (r.inside() && r.excess_bound > 0) return "what lies inside the sum has a bound of the excess above 0";
  const std::string why = why_unbounded(static_cast<ComparedWith>(r.a_compared_with),
                                        static_cast<ComparedWith>(r.b_compared_with));
  if (why.empty() != (r.error_bound >= 0)) {
    return why.empty() ? "there is no error bound, and no reason" : "there is an error bound, but " + why;
  }
  return {};
}

}  // namespace ballflow::geometry
