// How large surface balls are, and on which ground their union has the topology of the surface.
#pragma once

#include <cstdint>
#include <string>

namespace ballflow::geometry {

/// On what ground the union of pruned balls has the topology of the surface.
enum class SurfaceRegime : std::uint8_t {
  proven,     // thesis, Theorem 4.14 with its proof repaired: for dense samples
  supported,  // rho in the range that the thesis uses in practice, [0.24, 0.56], and rho_bar up to 0.6 of it
  heuristic,  // experience
};
const char* name(SurfaceRegime regime);

struct SurfaceBallsReport {
  double radius = 0;        // rho
  double shrink = 0;        // rho_bar
  std::uint8_t regime = 2;  // a SurfaceRegime
  std::int64_t samples = 0;
  std::int64_t raised = 0;  // balls that a floor made larger than rho D^
  std::int64_t coarse = 0;  // samples whose third neighbour is farther than 0.8 D^
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const SurfaceBallsReport& report);

}  // namespace ballflow::geometry
