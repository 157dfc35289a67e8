#include "prior/shape_model.hpp"

#include <cmath>

#include "exact/exponential.hpp"

namespace ballflow::geometry {
namespace {

LabelledPoints columns(const Array<Vec3>& points) {
  LabelledPoints result(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    result.col(static_cast<Eigen::Index>(i)) = Eigen::Vector3d(points[i].x, points[i].y, points[i].z);
  return result;
}

/// Centers, then points: what superpositions are made of.
LabelledPoints all_points(const LabelledShape& shape) {
  LabelledPoints all(3, shape.centers.cols() + shape.points.cols());
  all.leftCols(shape.centers.cols()) = shape.centers;
  all.rightCols(shape.points.cols()) = shape.points;
  return all;
}

double mean_size(const Eigen::VectorXd& weights, const LabelledPoints& points) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < points.cols(); ++i) middle += weights[i] * points.col(i);
  double sum = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) sum += weights[i] * (points.col(i) - middle).squaredNorm();
  return sum;
}

/// The direction of the sum of the instances' normals; of the first one where they cancel.
LabelledPoints mean_normals(std::span<const LabelledShape> instances,
                            const std::vector<Superposition>& poses) {
  LabelledPoints normals(3, instances[0].normals.cols());
  for (Eigen::Index point = 0; point < normals.cols(); ++point) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < instances.size(); ++i)
      sum += poses[i].rotation * instances[i].normals.col(point);
    if (!(sum.norm() > 1e-9)) sum = poses[0].rotation * instances[0].normals.col(point);
    normals.col(point) = sum / sum.norm();
  }
  return normals;
}

}  // namespace

LabelledShape labelled_shape(const MatchedBalls& matched, bool carried) {
  const bool smooth = carried && !matched.carried_radii.empty();
  const Array<double>& radii = smooth ? matched.carried_radii : matched.radii;
  LabelledShape shape;
  shape.centers = columns(smooth ? matched.carried : matched.centers);
  shape.log_radii.resize(static_cast<Eigen::Index>(radii.size()));
  for (std::size_t i = 0; i < radii.size(); ++i)
    shape.log_radii[static_cast<Eigen::Index>(i)] = logarithm(radii[i]);
  shape.points = columns(matched.points);
  shape.normals = columns(matched.normals);
  return shape;
}

LabelledShape transformed(const Superposition& pose, const LabelledShape& shape) {
  LabelledShape result;
  result.centers = transformed(pose, shape.centers);
  result.log_radii = shape.log_radii.array() + logarithm(pose.scale);
  result.points = transformed(pose, shape.points);
  result.normals.resize(3, shape.normals.cols());
  for (Eigen::Index i = 0; i < shape.normals.cols(); ++i)
    result.normals.col(i) = pose.rotation * shape.normals.col(i);
  return result;
}

ShapeModel shape_model(std::span<const LabelledShape> instances, const ShapeModelOptions& options,
                       Monitor& monitor) {
  ShapeModel model;
  model.balls = instances[0].balls();
  model.points = instances[0].points.cols();
  model.scale = options.scale;
  const double point_share = model.points == 0 ? 0 : options.point_share;
  const double per_ball = (1 - point_share) / static_cast<double>(model.balls);
  const double per_point = model.points == 0 ? 0 : point_share / static_cast<double>(model.points);
  model.weights.resize(model.balls + model.points);
  model.weights.head(model.balls).setConstant(per_ball);
  model.weights.tail(model.points).setConstant(per_point);

  std::vector<LabelledPoints> labelled;
  for (const LabelledShape& shape : instances) labelled.push_back(all_points(shape));
  GeneralizedProcrustesOptions superposition;
  superposition.scale = options.scale;
  model.poses = generalized_procrustes(labelled, model.weights, superposition, monitor).poses;

  Eigen::MatrixXd vectors(4 * model.balls + 3 * model.points, static_cast<Eigen::Index>(instances.size()));
  Eigen::VectorXd sizes(vectors.cols());
  double radii = 0;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const LabelledShape shape = transformed(model.poses[i], instances[i]);
    vectors.col(column) = vector_of(shape);
    sizes[column] = mean_size(model.weights, labelled[i]);
    for (Eigen::Index ball = 0; ball < model.balls; ++ball) radii += exponential(shape.log_radii[ball]);
  }
  radii /= static_cast<double>(model.balls * vectors.cols());
  model.metric = {per_ball, per_point, options.radius_weight * radii, options.along,
                  mean_normals(instances, model.poses)};
  const Eigen::VectorXd first = vectors.col(0);
  Eigen::MatrixXd features(4 * model.balls + 4 * model.points, vectors.cols());
  for (Eigen::Index i = 0; i < vectors.cols(); ++i)
    features.col(i) = model.metric.features(vectors.col(i) - first);
  model.linear = linear_model(vectors, features, sizes, options.modes);
  return model;
}

Eigen::VectorXd ShapeMetric::features(const Eigen::VectorXd& displacement) const {
  const Eigen::Index m = normals.cols(), k = (displacement.size() - 3 * m) / 4;
  Eigen::VectorXd result(4 * k + 4 * m);
  const double ball = std::sqrt(per_ball), off = std::sqrt(per_point), beside = std::sqrt(per_point * along);
  result.head(3 * k) = ball * displacement.head(3 * k);
  result.segment(3 * k, k) = (ball * radius_unit) * displacement.segment(3 * k, k);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::Vector3d moved = displacement.segment<3>(4 * k + 3 * i);
    const double height = moved.dot(normals.col(i));
    result[4 * k + 4 * i] = off * height;
    result.segment<3>(4 * k + 4 * i + 1) = beside * (moved - height * normals.col(i));
  }
  return result;
}

Eigen::VectorXd vector_of(const LabelledShape& shape) {
  const Eigen::Index k = shape.balls(), m = shape.points.cols();
  Eigen::VectorXd vector(4 * k + 3 * m);
  for (Eigen::Index i = 0; i < k; ++i) vector.segment<3>(3 * i) = shape.centers.col(i);
  vector.segment(3 * k, k) = shape.log_radii;
  for (Eigen::Index i = 0; i < m; ++i) vector.segment<3>(4 * k + 3 * i) = shape.points.col(i);
  return vector;
}

LabelledShape shape_of(const Eigen::VectorXd& vector, Eigen::Index balls) {
  const Eigen::Index m = (vector.size() - 4 * balls) / 3;
  LabelledShape shape;
  shape.centers.resize(3, balls);
  shape.points.resize(3, m);
  for (Eigen::Index i = 0; i < balls; ++i) shape.centers.col(i) = vector.segment<3>(3 * i);
  shape.log_radii = vector.segment(3 * balls, balls);
  for (Eigen::Index i = 0; i < m; ++i) shape.points.col(i) = vector.segment<3>(4 * balls + 3 * i);
  return shape;
}

Projection project(const ShapeModel& model, const LabelledShape& shape, Eigen::Index modes) {
  constexpr int rounds = 50;
  constexpr double standstill = 1e-10;  // standard deviations
  LinearModel first = model.linear;
  const Eigen::Index count = std::min(modes, first.size());
  first.modes = model.linear.modes.leftCols(count);
  first.feature_modes = model.linear.feature_modes.leftCols(count);
  first.variances = model.linear.variances.head(count);
  const LabelledPoints labelled = all_points(shape);
  Projection result;
  result.scores = Eigen::VectorXd::Zero(count);
  for (int round = 0; round < rounds; ++round) {
    const LabelledPoints target = all_points(shape_of(vector_of(first, result.scores), model.balls));
    result.pose = superimpose(labelled, target, model.weights, model.scale);
    const Eigen::VectorXd scores =
        scores_of(first, model.metric.features(vector_of(transformed(result.pose, shape)) - first.mean));
    const double change = count == 0 ? 0 : (scores - result.scores).cwiseAbs().maxCoeff();
    result.scores = scores;
    if (change <= standstill) break;
  }
  return result;
}

double model_distance(const ShapeModel& model, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return model.metric.features(a - b).norm();
}

}  // namespace ballflow::geometry
