// Labelled points laid on each other: Procrustes superposition, of two sets and of many.
#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "base/monitor.hpp"

namespace ballflow::geometry {

/// Column i is the point with label i, model units.
using LabelledPoints = Eigen::Matrix3Xd;

/// x -> scale * rotation * x + translation; the rotation has determinant +1.
struct Superposition {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

LabelledPoints transformed(const Superposition& pose, const LabelledPoints& points);
/// Back to where the points come from.
Superposition inverse(const Superposition& pose);

/// The superposition with the least weighted sum of squared distances of `moved` from `target`, label by
/// label (Kabsch 1976, Umeyama 1991): a rotation, a translation, and a scale where `scale` is wanted.
/// Reflections are none of them. As many points of both and weights (>= 0, not all 0); where all points lie
/// on a line the rotation around it is any. Sums run in the order of the labels.
Superposition superimpose(const LabelledPoints& moved, const LabelledPoints& target,
                          const Eigen::VectorXd& weights, bool scale);

/// The least weighted sum of squared distances over superpositions that may mirror.
double mirrored_residual(const LabelledPoints& moved, const LabelledPoints& target,
                         const Eigen::VectorXd& weights);

struct GeneralizedProcrustesOptions {
  bool scale = false;        // instances may be scaled, too
  double tolerance = 1e-13;  // of the mean from round to round, relative to its size
  int rounds = 500;          // at most
};

struct ProcrustesMean {
  LabelledPoints mean;
  std::vector<Superposition> poses;  // of each instance, to the coordinates of the mean
  int rounds = 0;
};

/// Generalized Procrustes analysis (Gower 1975): superpositions of all instances for which the sum of their
/// squared distances from their mean is least, by turns: each is superimposed on the mean, the mean is taken
/// anew. No instance is privileged. With scales, the sum of the squared sizes of the instances stays what it
/// was (else all would shrink to a point).
///
/// The mean lies in the coordinates of the instance that is most like it (rotation and centroid; of equal
/// ones the first). Other orders of the instances change the result by rounding only; equal orders give equal
/// bits. At least one instance; all have the same number of points, at least one.
ProcrustesMean generalized_procrustes(std::span<const LabelledPoints> instances,
                                      const Eigen::VectorXd& weights,
                                      const GeneralizedProcrustesOptions& options,
                                      Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
