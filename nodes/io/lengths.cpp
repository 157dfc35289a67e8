#include "io/lengths.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

struct Unit {
  std::string_view name;
  double metres;
};
constexpr std::array units = {Unit{"um", 1e-6},   Unit{"mm", 1e-3},  Unit{"cm", 1e-2},     Unit{"dm", 0.1},
                              Unit{"m", 1},       Unit{"km", 1e3},   Unit{"mil", 2.54e-5}, Unit{"in", 0.0254},
                              Unit{"ft", 0.3048}, Unit{"yd", 0.9144}};

}  // namespace

double parse_scale(std::string_view text) {
  for (const Unit& unit : units) {
    if (text == unit.name) return unit.metres;
  }
  const auto factor = parse_real(text);
  if (factor && std::isfinite(*factor) && *factor > 0) return *factor;
  std::string names;
  for (const Unit& unit : units) names.append(names.empty() ? "" : ", ").append(unit.name);
  throw InputError("the scale " + excerpt(text) + " is no factor above 0 and no unit of length",
                   "units, which become metres, are " + names);
}

Tolerance parse_tolerance(std::string_view text) {
  Tolerance tolerance;
  tolerance.relative = text.ends_with('%');
  const auto value = parse_real(tolerance.relative ? text.substr(0, text.size() - 1) : text);
  if (value && std::isfinite(*value) && *value >= 0 && !(tolerance.relative && *value >= 100)) {
    tolerance.value = tolerance.relative ? *value / 100 : *value;
    return tolerance;
  }
  throw InputError(
      "the tolerance " + excerpt(text) + " is no length of at least 0",
      "write it in model units (1e-6), or as a share of the longest edge of the bounding box (0.01%)");
}

}  // namespace ballflow::geometry
