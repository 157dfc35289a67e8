#include "types/enclosure_fit.hpp"

#include <cmath>
#include <cstdio>

namespace ballflow::geometry {

std::string describe(const EnclosureFit& fit) {
  char text[96] = "";
  const auto kind = static_cast<FitKind>(fit.kind);
  if (kind == FitKind::uncovered_area) {
    std::snprintf(text, sizeof text, ", about %.1f %% of the surface in none", 100 * fit.loss / fit.area);
  } else if (kind == FitKind::uncovered_volume) {
    std::snprintf(text, sizeof text, ", about %.1f %% of the volume in none", 100 * fit.loss / fit.solid);
  } else if (fit.solid > 0) {
    std::snprintf(text, sizeof text, ", about %.1f %% of the solid's volume outside",
                  100 * fit.outside / fit.solid);
  } else {
    std::snprintf(text, sizeof text, ", about %.4g of volume around a surface that holds none", fit.outside);
  }
  return std::to_string(fit.balls) + (fit.balls == 1 ? " ball" : " balls") + text;
}

std::string broken_invariant(const EnclosureFit& fit) {
  if (fit.balls < 0 || fit.balls > fit.wanted) {
    return std::to_string(fit.balls) + " balls where at most " + std::to_string(fit.wanted) + " were wanted";
  }
  if (fit.kind > 2) return "there is no kind " + std::to_string(fit.kind) + " of a fit";
  if (fit.filled_voids < 0) return "fewer than no voids";
  for (const double number : {fit.solid, fit.outside, fit.area, fit.loss}) {
    if (!std::isfinite(number) || number < 0) return "a volume or an area is negative or no number";
  }
  return "";
}

}  // namespace ballflow::geometry
