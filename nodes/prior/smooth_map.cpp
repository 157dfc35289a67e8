#include "prior/smooth_map.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

namespace ballflow::geometry {
namespace {

constexpr double worst_residual = 1e-6;  // of the points' extent: the system is nearly singular

Eigen::Vector3d column(Vec3 p) { return {p.x, p.y, p.z}; }

}  // namespace

SmoothMap::SmoothMap(std::span<const Vec3> from, std::span<const Vec3> to) {
  const auto n = static_cast<Eigen::Index>(from.size());
  const char* const hint = "give different points that are not all in one plane";
  if (n < 4 || from.size() != to.size()) {
    throw InputError("a smooth map through " + std::to_string(from.size()) + " points and " +
                         std::to_string(to.size()) + " images",
                     "give four points at least, with one image each");
  }
  Eigen::Matrix3Xd points(3, n);
  for (Eigen::Index i = 0; i < n; ++i) points.col(i) = column(from[static_cast<std::size_t>(i)]);
  const Eigen::Vector3d center = points.rowwise().mean();
  points.colwise() -= center;
  scale_ = points.cwiseAbs().maxCoeff();
  if (!(scale_ > 0) || !std::isfinite(scale_)) throw InputError("all points are at one place", hint);
  points /= scale_;

  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4);
  Eigen::MatrixX3d images = Eigen::MatrixX3d::Zero(n + 4, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double r = (points.col(i) - points.col(j)).norm();
      system(i, j) = system(j, i) = r * r * r;
    }
    system(i, n) = system(n, i) = 1;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      system(i, n + 1 + axis) = system(n + 1 + axis, i) = points(axis, i);
    images.row(i) = column(to[static_cast<std::size_t>(i)]).transpose();
  }
  // Images about their middle: a translation of them all costs no digits.
  const Eigen::RowVector3d middle = images.topRows(n).colwise().mean();
  images.topRows(n).rowwise() -= middle;
  const Eigen::MatrixX3d weights = system.partialPivLu().solve(images);
  const double error = (system.topRows(n) * weights - images.topRows(n)).cwiseAbs().maxCoeff();
  const double extent = images.topRows(n).cwiseAbs().maxCoeff();
  if (!(error <= worst_residual * extent)) throw InputError("no smooth map goes through the points", hint);
  const auto row = [&](Eigen::Index i) { return Vec3{weights(i, 0), weights(i, 1), weights(i, 2)}; };
  for (Eigen::Index i = 0; i < n; ++i) {
    points_.push_back({points(0, i), points(1, i), points(2, i)});
    weights_.push_back(row(i));
  }
  constant_ = row(n) + Vec3{middle[0], middle[1], middle[2]};
  slopes_ = {row(n + 1), row(n + 2), row(n + 3)};
  middle_ = {center[0], center[1], center[2]};
}

Vec3 SmoothMap::at(Vec3 x) const {
  const Vec3 p = (1 / scale_) * (x - middle_);
  Vec3 sum = constant_ + p.x * slopes_[0] + p.y * slopes_[1] + p.z * slopes_[2];
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double r = distance(p, points_[i]);
    sum = sum + (r * r * r) * weights_[i];
  }
  return sum;
}

double SmoothMap::volume_factor(Vec3 x) const {
  const Vec3 p = (1 / scale_) * (x - middle_);
  std::array<Vec3, 3> slopes = slopes_;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 d = p - points_[i];
    const Vec3 weight = 3 * length(d) * weights_[i];
    slopes[0] = slopes[0] + d.x * weight;
    slopes[1] = slopes[1] + d.y * weight;
    slopes[2] = slopes[2] + d.z * weight;
  }
  return dot(slopes[0], cross(slopes[1], slopes[2])) / (scale_ * scale_ * scale_);
}

}  // namespace ballflow::geometry
