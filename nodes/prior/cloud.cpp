#include "prior/cloud.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numeric>

namespace ballflow::geometry {

std::vector<std::int32_t> farthest_points(std::span<const Vec3> points, std::size_t count, Monitor& monitor) {
  std::vector<std::int32_t> chosen;
  if (points.size() <= count) {
    chosen.resize(points.size());
    std::iota(chosen.begin(), chosen.end(), 0);
    return chosen;
  }
  Lookout look(monitor);
  Vec3 mean;
  for (const Vec3& p : points) mean = mean + p;
  mean = (1 / static_cast<double>(points.size())) * mean;
  std::vector<double> squared(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) squared[i] = squared_distance(points[i], mean);
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (squared[i] > squared[next]) next = i;
  squared.assign(points.size(), std::numeric_limits<double>::infinity());
  while (chosen.size() < count) {
    chosen.push_back(static_cast<std::int32_t>(next));
    look(points.size());
    const Vec3 last = points[next];
    double farthest = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
      squared[i] = std::min(squared[i], squared_distance(points[i], last));
      if (squared[i] > farthest) {
        farthest = squared[i];
        next = i;
      }
    }
  }
  return chosen;
}

PrincipalFrame principal_frame(std::span<const Vec3> points) {
  PrincipalFrame frame;
  const double n = static_cast<double>(points.size());
  for (const Vec3& p : points) frame.mean = frame.mean + p;
  frame.mean = (1 / n) * frame.mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) {
    const Vec3 v = p - frame.mean;
    const double c[3] = {v.x, v.y, v.z};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) covariance(i, j) += c[i] * c[j] / n;
  }
  frame.radius = std::sqrt(covariance.trace());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  for (int k = 0; k < 3; ++k) {
    frame.variances[static_cast<std::size_t>(k)] = std::max(0.0, solver.eigenvalues()[k]);
    const auto v = solver.eigenvectors().col(k);
    frame.axes[static_cast<std::size_t>(k)] = {v[0], v[1], v[2]};
  }
  if (dot(cross(frame.axes[0], frame.axes[1]), frame.axes[2]) < 0) frame.axes[0] = -frame.axes[0];
  return frame;
}

Cloud::Cloud(std::span<const Vec3> all, std::span<const Vec3> all_normals, std::size_t count,
             Monitor& monitor) {
  for (const std::int32_t i : farthest_points(all, count, monitor)) {
    points.push_back(all[static_cast<std::size_t>(i)]);
    if (!all_normals.empty()) normals.push_back(all_normals[static_cast<std::size_t>(i)]);
  }
  frame = principal_frame(points);
  tree_ = BoxTree(std::span<const Vec3>(points), 16, monitor);
}

Cloud::Nearest Cloud::nearest(Vec3 p) const {
  Nearest found{0, std::numeric_limits<double>::infinity()};
  tree_.smallest(p, found.distance, -1, [&](std::size_t i) {
    const double d = distance(p, points[i]);
    if (d < found.distance) found = {i, d};
    return d;
  });
  return found;
}

}  // namespace ballflow::geometry
