// A linear model of matched balls: what ShapePrior learns, and leaves one instance out of.
#pragma once

#include <span>
#include <vector>

#include "prior/generalized_procrustes.hpp"
#include "prior/linear_model.hpp"
#include "types/matched_balls.hpp"

namespace ballflow::geometry {

struct ShapeModelOptions {
  bool scale = false;        // instances are scaled to one size, and differ in shape alone
  double radius_weight = 1;  // how much logarithms of radii count, in mean radii
  double point_share =
      0.5;             // of the surface points in the metric, from 0 to 1; the rest is that of the balls
  double along = 0.1;  // weight of what moves points along the surface
  int modes = 1000;    // at most
};

/// An instance in its own coordinates. Its vector has 3 k coordinates of centers, k logarithms of radii, and
/// 3 m coordinates of surface points.
struct LabelledShape {
  LabelledPoints centers;     // k
  Eigen::VectorXd log_radii;  // k
  LabelledPoints points;      // m
  LabelledPoints normals;     // m

  Eigen::Index balls() const { return log_radii.size(); }
};

/// With the balls as the field carried them, where these are known, or with those that replaced them.
LabelledShape labelled_shape(const MatchedBalls& matched, bool carried);
LabelledShape transformed(const Superposition& pose, const LabelledShape& shape);

/// The inner product of displacements of all balls and points: a mean square, in squared model units.
struct ShapeMetric {
  double per_ball = 0, per_point = 0;  // weights
  double radius_unit = 0;              // a logarithm of a radius counts as a length of so much, model units
  double along = 1;                    // weight of what moves points along the surface
  LabelledPoints normals;              // of the points, of length 1

  /// A linear function, whose squared length is the square in the metric.
  Eigen::VectorXd features(const Eigen::VectorXd& displacement) const;
};

struct ShapeModel {
  LinearModel linear;
  ShapeMetric metric;
  Eigen::VectorXd weights;  // of the centers and the points in superpositions
  Eigen::Index balls = 0, points = 0;
  bool scale = false;
  std::vector<Superposition> poses;  // of the instances, to the coordinates of the model
};

/// Superimposes the instances by their centers and points (generalized Procrustes analysis) and takes the
/// principal components of their vectors.
///
/// The metric is a mean squared displacement, so variances are squared model units: (1 - point_share) times
/// the mean over the balls of dx^2 + dy^2 + dz^2 + (w d log r)^2, with w = radius_weight times the mean
/// radius of all balls and instances, and point_share times the mean over the points of the squared
/// displacement off the surface plus `along` times that along it, by the mean of the instances' normals. To
/// first order w d log r is the change of a radius for a ball of mean size.
///
/// At least one instance, all with as many balls and points. The same order, the same bits.
ShapeModel shape_model(std::span<const LabelledShape> instances, const ShapeModelOptions& options,
                       Monitor& monitor = no_monitor());

/// The instance as a vector, in the coordinates that it has.
Eigen::VectorXd vector_of(const LabelledShape& shape);
/// Centers, radii and points of a vector, without normals.
LabelledShape shape_of(const Eigen::VectorXd& vector, Eigen::Index balls);

/// An instance as the model sees it.
struct Projection {
  Superposition pose;      // from the instance to the model
  Eigen::VectorXd scores;  // with the first `modes` modes
};

/// The pose and the scores for which the model is next to the instance, label by label, by turns.
Projection project(const ShapeModel& model, const LabelledShape& shape, Eigen::Index modes);

/// Root of the square of the difference in the metric.
double model_distance(const ShapeModel& model, const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace ballflow::geometry
