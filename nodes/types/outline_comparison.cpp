#include "types/outline_comparison.hpp"

namespace ballflow::geometry {

std::string broken_invariant(const OutlineComparison& c) {
  for (const double x : {c.area_a, c.area_b, c.only_a, c.only_b, c.a_to_b_at_least, c.b_to_a_at_least}) {
    // Written so that nan fails.
    if (!(x >= 0)) return "an area or a distance is negative, or no number";
  }
  if (!(c.a_to_b_at_least <= c.a_to_b_at_most && c.b_to_a_at_least <= c.b_to_a_at_most))
    return "a distance is at least more than at most";
  return {};
}

}  // namespace ballflow::geometry
