#include "types/shape_pose.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/arctangent.hpp"

namespace ballflow::geometry {
namespace {

double determinant(const std::array<double, 9>& r) {
  return r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
         r[2] * (r[3] * r[7] - r[4] * r[6]);
}

}  // namespace

Vec3 turned(const ShapePose& pose, Vec3 v) {
  const std::array<double, 9>& r = pose.rotation;
  return {r[0] * v.x + r[1] * v.y + r[2] * v.z, r[3] * v.x + r[4] * v.y + r[5] * v.z,
          r[6] * v.x + r[7] * v.y + r[8] * v.z};
}

Vec3 transformed(const ShapePose& pose, Vec3 p) { return pose.scale * turned(pose, p) + pose.translation; }

ShapePose inverse(const ShapePose& pose) {
  ShapePose back;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) back.rotation[3 * i + j] = pose.rotation[3 * j + i];
  back.scale = 1 / pose.scale;
  back.translation = -back.scale * turned(back, pose.translation);
  back.similarity = pose.similarity;
  back.mirrored = pose.mirrored;
  return back;
}

double degrees_between(const ShapePose& a, const ShapePose& b) {
  if (a.mirrored != b.mirrored) return 180;
  // The chord of the angle t is |A - B| = 2 sqrt 2 sin(t/2): exact for small angles, too.
  double squared = 0;
  for (std::size_t k = 0; k < 9; ++k) {
    const double d = a.rotation[k] - b.rotation[k];
    squared += d * d;
  }
  const double sine = std::min(1.0, std::sqrt(squared / 8));
  return 2 * arctangent(sine, std::sqrt(std::max(0.0, 1 - sine * sine))) * 180 / pi;
}

double relative_residual(const ShapePose& pose) {
  return pose.diagonal > 0
             ? std::sqrt(pose.forward * pose.forward + pose.backward * pose.backward) / pose.diagonal
             : 0;
}

std::string broken_invariant(const ShapePose& p) {
  constexpr double tolerance = 1e-9;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      double product = 0;
      for (std::size_t k = 0; k < 3; ++k) product += p.rotation[3 * i + k] * p.rotation[3 * j + k];
      if (!(std::abs(product - (i == j ? 1 : 0)) <= tolerance))
        return "rows " + std::to_string(i) + " and " + std::to_string(j) +
               " of the rotation are not orthonormal";
    }
  }
  if ((determinant(p.rotation) > 0) != (p.mirrored == 0))
    return p.mirrored == 0 ? "the rotation mirrors" : "the rotation does not mirror, as it should";
  if (!(p.scale > 0) || !std::isfinite(p.scale)) return "the scale is " + std::to_string(p.scale);
  if (p.similarity == 0 && p.scale != 1) return "a rigid transform has scale " + std::to_string(p.scale);
  if (!is_finite(p.translation)) return "the translation is not finite";
  for (const double value : {p.forward, p.backward, p.diagonal, p.mirror_image})
    if (!(value >= 0) || !std::isfinite(value)) return "a residual is negative or not finite";
  if (p.second_best != 0 && !(p.second_best >= 1 && std::isfinite(p.second_best)))
    return "the second best pose is better than the best one";
  if (p.starts < 0) return "the number of starts is negative";
  return {};
}

}  // namespace ballflow::geometry
