#include "types/surface_report.hpp"

namespace ballflow::geometry {

std::string broken_invariant(const SurfaceReport& report) {
  if (!(report.overruled >= 0 && report.overruled <= 1)) return "overruled is no share";
  if (!(report.filled_area >= 0 && report.filled_area <= 1)) return "filled_area is no share";
  for (std::size_t i = 0; i < report.vertex_balls.size(); ++i) {
    if (report.vertex_balls[i] < -1) return "vertex " + std::to_string(i) + " has a negative ball";
  }
  for (std::size_t i = 0; i < report.filled.size(); ++i) {
    if (report.filled[i] > 1) return "filled of triangle " + std::to_string(i) + " is neither 0 nor 1";
  }
  return {};
}

}  // namespace ballflow::geometry
