#include "prior/linear_model.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ballflow::geometry {
namespace {

constexpr double rounding = 1e-12;  // of the largest variance
constexpr double as_large = 1e-6;

/// Eigen's own products sum in an order that follows the cache of the machine.
double inner(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::Ref<const Eigen::VectorXd>& y) {
  double sum = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

Eigen::MatrixXd around_mean(const Eigen::MatrixXd& columns, Eigen::VectorXd& mean) {
  mean = Eigen::VectorXd::Zero(columns.rows());
  for (Eigen::Index i = 0; i < columns.cols(); ++i) mean += columns.col(i);
  mean /= static_cast<double>(columns.cols());
  return columns.colwise() - mean;
}

double sign_of(const Eigen::VectorXd& scores, const Eigen::VectorXd& sizes) {
  const double largest = scores.cwiseAbs().maxCoeff();
  Eigen::Index decides = -1;
  for (Eigen::Index i = 0; i < scores.size(); ++i) {
    if (std::abs(scores[i]) < (1 - as_large) * largest) continue;
    if (decides < 0 || sizes[i] > sizes[decides]) decides = i;
  }
  return scores[decides] < 0 ? -1 : 1;
}

}  // namespace

LinearModel linear_model(const Eigen::MatrixXd& vectors, const Eigen::MatrixXd& features,
                         const Eigen::VectorXd& sizes, Eigen::Index most) {
  const Eigen::Index n = vectors.cols();
  LinearModel model;
  Eigen::VectorXd feature_mean;
  const Eigen::MatrixXd centered = around_mean(vectors, model.mean);
  const Eigen::MatrixXd centered_features = around_mean(features, feature_mean);

  Eigen::MatrixXd gram(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      gram(i, j) = gram(j, i) = inner(centered_features.col(i), centered_features.col(j));
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);  // ascending
  const Eigen::VectorXd& values = solver.eigenvalues();
  Eigen::Index count = 0;
  while (count < std::min(most, n - 1) && values[n - 1 - count] > 0 &&
         values[n - 1 - count] > rounding * values[n - 1])
    ++count;

  model.variances.resize(count);
  model.scores.resize(n, count);
  model.modes = Eigen::MatrixXd::Zero(vectors.rows(), count);
  model.feature_modes = Eigen::MatrixXd::Zero(features.rows(), count);
  const double freedom = std::sqrt(static_cast<double>(n - 1));
  for (Eigen::Index mode = 0; mode < count; ++mode) {
    const double value = values[n - 1 - mode];
    Eigen::VectorXd scores = freedom * solver.eigenvectors().col(n - 1 - mode);
    scores *= sign_of(scores, sizes);
    model.variances[mode] = value / static_cast<double>(n - 1);
    model.scores.col(mode) = scores;
    // scores / (n - 1) leads from the columns to what a standard deviation adds.
    for (Eigen::Index i = 0; i < n; ++i) {
      const double part = scores[i] / static_cast<double>(n - 1);
      model.modes.col(mode) += part * centered.col(i);
      model.feature_modes.col(mode) += part * centered_features.col(i);
    }
  }
  return model;
}

Eigen::VectorXd scores_of(const LinearModel& model, const Eigen::VectorXd& features) {
  Eigen::VectorXd scores(model.size());
  for (Eigen::Index mode = 0; mode < model.size(); ++mode)
    scores[mode] = inner(features, model.feature_modes.col(mode)) / model.variances[mode];
  return scores;
}

Eigen::VectorXd vector_of(const LinearModel& model, const Eigen::VectorXd& scores) {
  Eigen::VectorXd vector = model.mean;
  for (Eigen::Index mode = 0; mode < scores.size(); ++mode) vector += scores[mode] * model.modes.col(mode);
  return vector;
}

}  // namespace ballflow::geometry
