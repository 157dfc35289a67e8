// Principal components of a few long vectors.
#pragma once

#include <Eigen/Dense>

namespace ballflow::geometry {

/// mean + modes * b is an instance; b is measured in standard deviations.
struct LinearModel {
  Eigen::VectorXd mean;           // D
  Eigen::MatrixXd modes;          // D x q: what one standard deviation adds
  Eigen::MatrixXd feature_modes;  // L x q: the same of the features
  Eigen::VectorXd variances;      // q, descending, of the features
  Eigen::MatrixXd scores;         // n x q, of the vectors that it was made from, in standard deviations

  Eigen::Index size() const { return variances.size(); }
};

/// Principal components of the columns of `features` (L x n, whose mean need not be 0). The columns of
/// `vectors` (D x n) follow the scores: the modes are linear in them, and right for the columns themselves.
///
/// - The variance of a mode is that of n - 1 degrees of freedom. Modes below 1e-12 of the first one's
/// variance
///   are rounding and left out; at most `most` stay, and n - 1.
/// - The sign of a mode: its score of largest absolute value is positive. Of scores that are as large but for
///   1e-6 (two instances always are) that of the column with the largest `sizes` entry decides. So signs do
///   not depend on how space is turned.
/// - By the n x n matrix of inner products, in a fixed order of sums: time O((D + L) n^2).
LinearModel linear_model(const Eigen::MatrixXd& vectors, const Eigen::MatrixXd& features,
                         const Eigen::VectorXd& sizes, Eigen::Index most);

/// The scores of a vector, by the features of its difference from the mean: those of the point of the model
/// that is next to it.
Eigen::VectorXd scores_of(const LinearModel& model, const Eigen::VectorXd& features);

/// The mean and the first modes of a model with these scores.
Eigen::VectorXd vector_of(const LinearModel& model, const Eigen::VectorXd& scores);

}  // namespace ballflow::geometry
