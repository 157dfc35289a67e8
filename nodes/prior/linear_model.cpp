#include "prior/linear_model.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ballflow::geometry {
namespace {

constexpr double rounding = 1e-12;   // of the largest variance
constexpr double as_large = 1e-6;

/// Eigen's own products sum in an order that follows the cache of the machine.
double inner(const Eigen::VectorXd& metric, const double* x, const double* y) {
  double sum = 0;
  for (Eigen::Index i = 0; i < metric.size(); ++i) sum += metric[i] * x[i] * y[i];
  return sum;
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

LinearModel linear_model(const Eigen::MatrixXd& vectors, const Eigen::VectorXd& metric,
                         const Eigen::VectorXd& sizes, Eigen::Index most) {
  const Eigen::Index n = vectors.cols(), length = vectors.rows();
  LinearModel model;
  model.mean = Eigen::VectorXd::Zero(length);
  for (Eigen::Index i = 0; i < n; ++i) model.mean += vectors.col(i);
  model.mean /= static_cast<double>(n);
  const Eigen::MatrixXd centered = vectors.colwise() - model.mean;

  Eigen::MatrixXd gram(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      gram(i, j) = gram(j, i) = inner(metric, centered.col(i).data(), centered.col(j).data());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);  // ascending
  const Eigen::VectorXd& values = solver.eigenvalues();
  Eigen::Index count = 0;
  while (count < std::min(most, n - 1) && values[n - 1 - count] > 0 &&
         values[n - 1 - count] > rounding * values[n - 1])
    ++count;

  model.variances.resize(count);
  model.scores.resize(n, count);
  model.modes = Eigen::MatrixXd::Zero(length, count);
  const double freedom = std::sqrt(static_cast<double>(n - 1));
  for (Eigen::Index mode = 0; mode < count; ++mode) {
    const double value = values[n - 1 - mode];
    Eigen::VectorXd scores = freedom * solver.eigenvectors().col(n - 1 - mode);
    scores *= sign_of(scores, sizes);
    model.variances[mode] = value / static_cast<double>(n - 1);
    model.scores.col(mode) = scores;
    // scores / (n - 1) leads from the columns to what a standard deviation adds.
    for (Eigen::Index i = 0; i < n; ++i)
      model.modes.col(mode) += (scores[i] / static_cast<double>(n - 1)) * centered.col(i);
  }
  return model;
}

Eigen::VectorXd scores_of(const LinearModel& model, const Eigen::VectorXd& metric,
                          const Eigen::VectorXd& vector) {
  const Eigen::VectorXd difference = vector - model.mean;
  Eigen::VectorXd scores(model.size());
  for (Eigen::Index mode = 0; mode < model.size(); ++mode)
    scores[mode] = inner(metric, difference.data(), model.modes.col(mode).data()) / model.variances[mode];
  return scores;
}

Eigen::VectorXd vector_of(const LinearModel& model, const Eigen::VectorXd& scores) {
  Eigen::VectorXd vector = model.mean;
  for (Eigen::Index mode = 0; mode < scores.size(); ++mode) vector += scores[mode] * model.modes.col(mode);
  return vector;
}

}  // namespace ballflow::geometry
