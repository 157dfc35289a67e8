#include "types/surface_report.hpp"

namespace ballflow::geometry {

std::string broken_invariant(const SurfaceReport& report) {
  const auto is_share = [](double x) { return x >= 0 && x <= 1; };
  if (!is_share(report.overruled)) return "overruled is no share";
  if (!is_share(report.filled_area) || !is_share(report.wide_area)) return "filled_area is no share";
  if (!is_share(report.left_out_area)) return "left_out_area is no share";
  if (!(report.farthest >= 0)) return "farthest is negative";
  if (report.left_out_patch < 0 || report.left_out_patch > report.left_out)
    return "left_out_patch is not from 0 to left_out";
  if (!is_finite(report.patch_at)) return "patch_at is not finite";
  const std::size_t n = report.vertices.size(), m = report.triangles.size();
  if (report.vertex_balls.size() != n)
    return std::to_string(n) + " vertices but " + std::to_string(report.vertex_balls.size()) + " balls";
  if (report.filled.size() != m || report.contradicted.size() != m) {
    return std::to_string(m) + " triangles but " + std::to_string(report.filled.size()) + " and " +
           std::to_string(report.contradicted.size()) + " flags";
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (report.vertex_balls[i] < -1) return "vertex " + std::to_string(i) + " has a negative ball";
    if (!is_finite(report.vertices[i])) return "vertex " + std::to_string(i) + " is not finite";
  }
  for (std::size_t i = 0; i < m; ++i) {
    if (report.filled[i] > 2) return "filled of triangle " + std::to_string(i) + " is not 0, 1 or 2";
    if (report.contradicted[i] > 1)
      return "contradicted of triangle " + std::to_string(i) + " is neither 0 nor 1";
    for (const std::int32_t v : report.triangles[i]) {
      if (v < 0 || static_cast<std::size_t>(v) >= n)
        return "triangle " + std::to_string(i) + " has the vertex " + std::to_string(v) + " of " +
               std::to_string(n);
    }
  }
  return {};
}

}  // namespace ballflow::geometry
