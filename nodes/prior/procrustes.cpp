#include "prior/procrustes.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <stdexcept>

namespace ballflow::geometry {
namespace {

/// The rotation of a unit quaternion (w, x, y, z), rows.
std::array<double, 9> rotation_of(const Eigen::Vector4d& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double n = w * w + x * x + y * y + z * z;  // 1 but for rounding
  return {(w * w + x * x - y * y - z * z) / n,
          2 * (x * y - w * z) / n,
          2 * (x * z + w * y) / n,
          2 * (x * y + w * z) / n,
          (w * w - x * x + y * y - z * z) / n,
          2 * (y * z - w * x) / n,
          2 * (x * z - w * y) / n,
          2 * (y * z + w * x) / n,
          (w * w - x * x - y * y + z * z) / n};
}

}  // namespace

ShapePose labelled_pose(std::span<const Vec3> from, std::span<const Vec3> to, std::span<const double> weights,
                        const ProcrustesOptions& options) {
  if (from.empty() || from.size() != to.size() || (!weights.empty() && weights.size() != from.size()))
    throw std::logic_error("Procrustes analysis needs as many points and weights on both sides");
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  double total = 0;
  Vec3 from_mean, to_mean;
  for (std::size_t i = 0; i < from.size(); ++i) {
    total += weight(i);
    from_mean = from_mean + weight(i) * from[i];
    to_mean = to_mean + weight(i) * to[i];
  }
  if (!(total > 0)) throw std::logic_error("Procrustes analysis with weights 0");
  from_mean = (1 / total) * from_mean;
  to_mean = (1 / total) * to_mean;

  // A reflection is a rotation of the points mirrored at their mean.
  const double sign = options.mirror ? -1 : 1;
  double s[3][3] = {};
  double from_spread = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 a = sign * (from[i] - from_mean), b = to[i] - to_mean;
    const double w = weight(i);
    const double p[3] = {a.x, a.y, a.z}, q[3] = {b.x, b.y, b.z};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) s[r][c] += w * p[r] * q[c];
    from_spread += w * squared_length(a);
  }
  Eigen::Matrix4d m;
  m << s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0],  //
      s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2],   //
      s[2][0] - s[0][2], s[0][1] + s[1][0], -s[0][0] + s[1][1] - s[2][2], s[1][2] + s[2][1],  //
      s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], -s[0][0] - s[1][1] + s[2][2];
  // Products of tiny or huge lengths leave the range of doubles; only their proportions matter here.
  const double largest = m.cwiseAbs().maxCoeff();
  ShapePose pose;
  pose.similarity = options.similarity ? 1 : 0;
  pose.mirrored = options.mirror ? 1 : 0;
  double product = 0;
  if (largest > 0) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(m / largest);
    pose.rotation = rotation_of(solver.eigenvectors().col(3));
    product = solver.eigenvalues()[3] * largest;
  }
  if (options.mirror)
    for (double& entry : pose.rotation) entry = -entry;
  if (options.similarity && from_spread > 0 && product > 0) pose.scale = product / from_spread;
  pose.translation = to_mean - pose.scale * turned(pose, from_mean);
  double squared = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    squared += weight(i) * squared_distance(transformed(pose, from[i]), to[i]);
  pose.forward = std::sqrt(squared / total);
  return pose;
}

}  // namespace ballflow::geometry
