#include "types/outline_comparison.hpp"

namespace ballflow::geometry {

std::string broken_invariant(const OutlineComparison& c) {
  // Written so that nan fails.
  for (const double x : {c.area_a, c.area_b, c.only_a, c.only_b}) {
    if (!(c.areas_known() ? x >= 0 : x == -1)) return "an area is negative, or some are known and others not";
  }
  for (const double x : {c.a_to_b_at_least, c.b_to_a_at_least}) {
    if (!(x >= 0)) return "a distance is negative, or no number";
  }
  if (!(c.a_to_b_at_least <= c.a_to_b_at_most && c.b_to_a_at_least <= c.b_to_a_at_most))
    return "a distance is at least more than at most";
  return {};
}

}  // namespace ballflow::geometry
