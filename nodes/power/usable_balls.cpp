#include "power/usable_balls.hpp"

#include <cmath>
#include <cstdio>
#include <string>

#include "base/monitor.hpp"

namespace ballflow::geometry {

void require_usable(const Balls& balls, const char* name) {
  if (const std::string broken = broken_invariant(balls); !broken.empty()) {
    throw InputError("input " + std::string(name) + ": " + broken, "repair or remove the ball");
  }
  const auto usable = [](double x) { return x == 0 || (std::abs(x) >= 1e-150 && std::abs(x) <= 1e150); };
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 c = balls.centers[i];
    for (const double x : {c.x, c.y, c.z, balls.radii[i]}) {
      if (usable(x)) continue;
      char text[32];
      std::snprintf(text, sizeof text, "%g", x);
      throw InputError("input " + std::string(name) + ": ball " + std::to_string(i) +
                           " has the coordinate or radius " + text +
                           ", whose square leaves the range of doubles",
                       "scale all inputs, or set tiny numbers to 0");
    }
  }
}

void require_discs(const Balls& discs, const char* name, const char* instead) {
  require_usable(discs, name);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    if (discs.centers[i].z == 0) continue;
    throw InputError("input " + std::string(name) + ": ball " + std::to_string(i) +
                         " has its center at z = " + std::to_string(discs.centers[i].z) +
                         ", and discs have z = 0",
                     std::string(instead) + " takes balls in space");
  }
}

}  // namespace ballflow::geometry
