#include "types/matched_balls.hpp"

#include <cmath>

namespace ballflow::geometry {
namespace {

std::string broken_directions(const Array<Vec3>& normals, const char* name) {
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (!(std::abs(squared_length(normals[i]) - 1) < 1e-9))
      return std::string(name) + " " + std::to_string(i) + " is not of length 1";
  return {};
}

std::string broken_points(const Array<Vec3>& points, const char* name) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_finite(points[i])) return std::string(name) + " " + std::to_string(i) + " is not finite";
  return {};
}

}  // namespace

ShapePose pose_of(const MatchedBalls& m) {
  ShapePose pose;
  pose.rotation = m.rotation;
  pose.scale = m.scale;
  pose.translation = m.translation;
  pose.similarity = m.similarity;
  pose.mirrored = m.mirrored;
  return pose;
}

Balls balls_of(const MatchedBalls& matched) { return {matched.centers, matched.radii, {}, {}}; }

std::string broken_invariant(const MatchedBalls& m) {
  const std::size_t k = m.radii.size();
  for (const std::size_t size :
       {m.centers.size(), m.carried.size(), m.residuals.size(), m.partners.size(), m.unique.size()})
    if (size != k) return "not as many of everything as there are balls";
  if (!m.carried_radii.empty() && m.carried_radii.size() != k) return "not as many carried radii as balls";
  for (std::size_t i = 0; i < m.carried_radii.size(); ++i)
    if (!(m.carried_radii[i] > 0) || !std::isfinite(m.carried_radii[i]))
      return "the carried ball " + std::to_string(i) + " has radius " + std::to_string(m.carried_radii[i]);
  if (m.normals.size() != m.points.size() || m.point_residuals.size() != m.points.size())
    return "not as many normals or residuals as there are points";
  if (m.sample_normals.size() != m.samples.size()) return "not as many normals as samples";
  for (std::size_t i = 0; i < k; ++i) {
    const std::string ball = "ball " + std::to_string(i);
    if (!is_finite(m.centers[i]) || !is_finite(m.carried[i]))
      return "the center of " + ball + " is not finite";
    if (!(m.radii[i] > 0) || !std::isfinite(m.radii[i]))
      return ball + " has radius " + std::to_string(m.radii[i]);
    if (!(m.residuals[i] >= 0) || !std::isfinite(m.residuals[i]))
      return "the residual of " + ball + " is negative or not finite";
    if (m.partners[i] > 1 || m.unique[i] > m.partners[i]) return ball + " is unique without a partner";
  }
  for (std::size_t j = 0; j < m.points.size(); ++j)
    if (!(m.point_residuals[j] >= 0) || !std::isfinite(m.point_residuals[j]))
      return "the residual of point " + std::to_string(j) + " is negative or not finite";
  if (!(m.diagonal >= 0) || !std::isfinite(m.diagonal)) return "the diagonal is negative or not finite";
  for (const std::string& why :
       {broken_points(m.points, "point"), broken_points(m.samples, "sample"),
        broken_directions(m.normals, "normal"), broken_directions(m.sample_normals, "the normal of sample")})
    if (!why.empty()) return why;
  if (std::string why = broken_invariant(pose_of(m)); !why.empty()) return "pose: " + why;
  return {};
}

}  // namespace ballflow::geometry
