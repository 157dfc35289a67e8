#include "types/mass_properties.hpp"

#include <algorithm>
#include <cmath>

namespace ballflow::geometry {

std::string broken_invariant(const MassProperties& p) {
  if (!(p.volume >= 0 && std::isfinite(p.volume))) return "the volume is negative or not finite";
  if (!(p.area >= 0 && std::isfinite(p.area))) return "the area is negative or not finite";
  if (!is_finite(p.center_of_mass)) return "the centre of mass is not finite";
  if (!std::all_of(p.inertia.begin(), p.inertia.end(), [](double x) { return std::isfinite(x); })) {
    return "the inertia tensor is not finite";
  }
  if (!(p.closure_error >= 0)) return "closure_error is negative";
  return {};
}

}  // namespace ballflow::geometry
