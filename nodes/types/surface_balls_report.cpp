#include "types/surface_balls_report.hpp"

namespace ballflow::geometry {

const char* name(SurfaceRegime regime) {
  switch (regime) {
    case SurfaceRegime::proven:
      return "proven";
    case SurfaceRegime::supported:
      return "supported";
    case SurfaceRegime::heuristic:
      return "heuristic";
  }
  return "";
}

std::string broken_invariant(const SurfaceBallsReport& report) {
  if (report.regime > static_cast<std::uint8_t>(SurfaceRegime::heuristic))
    return "there is no regime " + std::to_string(report.regime);
  if (!(report.shrink >= 0 && report.shrink <= report.radius)) return "shrink is not from 0 to radius";
  if (report.raised < 0 || report.raised > report.samples) return "raised is not from 0 to samples";
  if (report.coarse < 0 || report.coarse > report.samples) return "coarse is not from 0 to samples";
  return {};
}

}  // namespace ballflow::geometry
