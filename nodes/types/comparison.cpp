#include "types/comparison.hpp"

#include <algorithm>

namespace ballflow::geometry {
namespace {

bool in_order(double a, double b, double c) { return 0 <= a && a <= b && b <= c; }

bool sound(const OneSidedDistance& d) { return in_order(d.at_least, d.value, d.at_most) && 0 <= d.mean; }

}  // namespace

const char* in_words(ComparedWith what) {
  switch (what) {
    case ComparedWith::cloud:
      return "a cloud of points";
    case ComparedWith::open_mesh:
      return "an open mesh";
    case ComparedWith::closed_mesh:
      return "a closed mesh";
    case ComparedWith::nothing:
      break;
  }
  return "nothing";
}

double Comparison::hausdorff() const { return std::max(surface_to_union.value, union_to_surface.value); }
double Comparison::hausdorff_at_most() const {
  return std::max(surface_to_union.at_most, union_to_surface.at_most);
}

std::string broken_invariant(const Comparison& c) {
  if (c.compared_with < static_cast<std::uint8_t>(ComparedWith::cloud) ||
      c.compared_with > static_cast<std::uint8_t>(ComparedWith::closed_mesh)) {
    return "compared_with = " + std::to_string(c.compared_with) +
           " is neither 1 (cloud), 2 (open mesh) nor 3 (closed mesh)";
  }
  if (c.surface_samples < 0 || c.union_samples < 0) return "a number of samples is negative";
  if (!(c.spacing >= 0)) return "the spacing is not at least 0";
  if (!sound(c.surface_to_union))
    return "the bounds of the distance from the surface to the union are not in order";
  if (!sound(c.union_to_surface))
    return "the bounds of the distance from the union to the surface are not in order";
  if (!(c.coverage >= 0 && c.coverage <= 1)) return "the coverage is not in [0, 1]";
  if (!(c.uncovered >= 0 && c.protrusion >= 0)) return "uncovered or protrusion is negative";
  if (!(c.union_volume >= 0 && c.surface_volume >= 0)) return "a volume is negative";
  if (c.surface_encloses > 1) return "surface_encloses is neither 0 nor 1";
  if (c.surface_encloses != 0 && !c.with_closed_mesh()) {
    return "the surface encloses a volume and is no closed mesh";
  }
  return {};
}

}  // namespace ballflow::geometry
