#include "types/minkowski_report.hpp"

#include <cmath>

namespace ballflow::geometry {

std::string broken_invariant(const MinkowskiReport& r) {
  if (r.touching_boundary < 0) return "the number of balls on the boundary is negative";
  if (r.touching_boundary > r.count) return "more balls are on the boundary than contribute";
  if (r.count > r.survivors) return "more balls contribute than were triangulated";
  if (r.survivors > r.pairs) return "more balls were triangulated than there are pairs";
  if (r.count == 0 && r.pairs > 0) return "no ball contributes";
  if (!is_finite(r.lower) || !is_finite(r.upper)) return "the bounding box is not finite";
  if (!std::isfinite(r.error_bound)) return "the error bound is not finite";
  return {};
}

}  // namespace ballflow::geometry
