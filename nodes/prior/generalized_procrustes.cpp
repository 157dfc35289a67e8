#include "prior/generalized_procrustes.hpp"

#include <cmath>
#include <limits>

namespace ballflow::geometry {
namespace {

Eigen::Vector3d centroid(const LabelledPoints& points, const Eigen::VectorXd& weights) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    sum += weights[i] * points.col(i);
    total += weights[i];
  }
  return sum / total;
}

LabelledPoints centered(const LabelledPoints& points, const Eigen::VectorXd& weights) {
  return points.colwise() - centroid(points, weights);
}

/// Of centered points: the sum of their weighted squares.
double squared_size(const LabelledPoints& points, const Eigen::VectorXd& weights) {
  double sum = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) sum += weights[i] * points.col(i).squaredNorm();
  return sum;
}

Eigen::Matrix3d covariance(const LabelledPoints& target, const LabelledPoints& moved,
                           const Eigen::VectorXd& weights) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < moved.cols(); ++i) {
    const Eigen::Vector3d weighted = weights[i] * target.col(i);
    sum += weighted * moved.col(i).transpose();
  }
  return sum;
}

struct Turn {
  Eigen::Matrix3d rotation;
  double correlation = 0;  // the trace that the rotation makes largest
};

/// The rotation that makes the trace of its product with the transposed covariance largest.
Turn best_turn(const Eigen::Matrix3d& sum) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, 1);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs[2] = -1;
  return {svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose(), svd.singularValues().dot(signs)};
}

/// The sum of squared distances between columns.
double squared_difference(const LabelledPoints& a, const LabelledPoints& b, const Eigen::VectorXd& weights) {
  double sum = 0;
  for (Eigen::Index i = 0; i < a.cols(); ++i) sum += weights[i] * (a.col(i) - b.col(i)).squaredNorm();
  return sum;
}

}  // namespace

LabelledPoints transformed(const Superposition& pose, const LabelledPoints& points) {
  const Eigen::Matrix3d matrix = pose.scale * pose.rotation;
  LabelledPoints result(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) result.col(i) = matrix * points.col(i) + pose.translation;
  return result;
}

Superposition inverse(const Superposition& pose) {
  Superposition back;
  back.rotation = pose.rotation.transpose();
  back.scale = 1 / pose.scale;
  back.translation = -back.scale * (back.rotation * pose.translation);
  return back;
}

Superposition superimpose(const LabelledPoints& moved, const LabelledPoints& target,
                          const Eigen::VectorXd& weights, bool scale) {
  const Eigen::Vector3d from = centroid(moved, weights), to = centroid(target, weights);
  const LabelledPoints x = moved.colwise() - from, y = target.colwise() - to;
  const Turn turn = best_turn(covariance(y, x, weights));
  Superposition pose;
  pose.rotation = turn.rotation;
  if (scale) {
    const double size = squared_size(x, weights);
    if (size > 0 && turn.correlation > 0) pose.scale = turn.correlation / size;
  }
  pose.translation = to - pose.scale * (pose.rotation * from);
  return pose;
}

double mirrored_residual(const LabelledPoints& moved, const LabelledPoints& target,
                         const Eigen::VectorXd& weights) {
  LabelledPoints mirrored = moved;
  mirrored.row(0) = -mirrored.row(0);
  const Superposition pose = superimpose(mirrored, target, weights, false);
  return squared_difference(transformed(pose, mirrored), target, weights);
}

ProcrustesMean generalized_procrustes(std::span<const LabelledPoints> instances,
                                      const Eigen::VectorXd& weights,
                                      const GeneralizedProcrustesOptions& options, Monitor& monitor) {
  const std::size_t n = instances.size();
  const double count = static_cast<double>(n);
  std::vector<LabelledPoints> shapes;
  double total = 0;
  for (const LabelledPoints& instance : instances) {
    shapes.push_back(centered(instance, weights));
    total += squared_size(shapes.back(), weights);
  }

  // Shapes are turned and scaled from where they were, so that rounding does not add up.
  std::vector<Eigen::Matrix3d> rotations(n, Eigen::Matrix3d::Identity());
  std::vector<double> scales(n, 1.0);
  ProcrustesMean result;
  result.mean = shapes[0];
  for (result.rounds = 1; result.rounds <= options.rounds; ++result.rounds) {
    double scaled = 0;
    for (std::size_t i = 0; i < n; ++i) {
      monitor.step(static_cast<double>(result.rounds - 1) / options.rounds);
      const Turn turn = best_turn(covariance(result.mean, shapes[i], weights));
      rotations[i] = turn.rotation;
      const double size = squared_size(shapes[i], weights);
      if (options.scale && size > 0 && turn.correlation > 0) scales[i] = turn.correlation / size;
      scaled += scales[i] * scales[i] * size;
    }
    if (options.scale && scaled > 0) {
      const double back = std::sqrt(total / scaled);
      for (double& scale : scales) scale *= back;
    }
    LabelledPoints mean = LabelledPoints::Zero(3, result.mean.cols());
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Matrix3d matrix = (scales[i] / count) * rotations[i];
      for (Eigen::Index j = 0; j < mean.cols(); ++j) mean.col(j) += matrix * shapes[i].col(j);
    }
    const double change = squared_difference(mean, result.mean, weights);
    result.mean = std::move(mean);
    if (!(change > options.tolerance * options.tolerance * squared_size(result.mean, weights))) break;
  }

  std::size_t typical = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Matrix3d matrix = scales[i] * rotations[i];
    double difference = 0;
    for (Eigen::Index j = 0; j < result.mean.cols(); ++j)
      difference += weights[j] * (matrix * shapes[i].col(j) - result.mean.col(j)).squaredNorm();
    if (difference < least) least = difference, typical = i;
  }
  const Eigen::Matrix3d turn = rotations[typical].transpose();
  const Eigen::Vector3d place = centroid(instances[typical], weights);
  for (Eigen::Index j = 0; j < result.mean.cols(); ++j)
    result.mean.col(j) = (turn * result.mean.col(j) + place).eval();
  for (std::size_t i = 0; i < n; ++i) {
    Superposition pose;
    pose.rotation = turn * rotations[i];
    pose.scale = scales[i];
    pose.translation = place - pose.scale * (pose.rotation * centroid(instances[i], weights));
    result.poses.push_back(pose);
  }
  return result;
}

}  // namespace ballflow::geometry
