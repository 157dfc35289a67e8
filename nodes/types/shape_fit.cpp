#include "types/shape_fit.hpp"

#include <cmath>

namespace ballflow::geometry {

std::string broken_invariant(const ShapeFit& fit) {
  const std::size_t q = fit.scores.size(), k = fit.radii.size();
  if (fit.covariance.size() != q * q) return "the covariance is not scores x scores";
  if (k == 0) return "a fit without balls";
  if (fit.centers.size() != k || fit.deviations.size() != k) return "not one center and deviation a ball";
  for (std::size_t i = 0; i < q; ++i) {
    if (!std::isfinite(fit.scores[i])) return "score " + std::to_string(i) + " is not finite";
    for (std::size_t j = 0; j < q; ++j) {
      if (!std::isfinite(fit.covariance[i * q + j]) || fit.covariance[i * q + j] != fit.covariance[j * q + i])
        return "the covariance of scores " + std::to_string(i) + " and " + std::to_string(j) +
               " is not finite, or not symmetric";
    }
    if (!(fit.covariance[i * q + i] >= 0))
      return "the variance of score " + std::to_string(i) + " is negative";
  }
  for (std::size_t i = 0; i < k; ++i) {
    if (!is_finite(fit.centers[i])) return "the center of ball " + std::to_string(i) + " is not finite";
    if (!(fit.radii[i] > 0) || !std::isfinite(fit.radii[i]))
      return "the radius of ball " + std::to_string(i) + " is not above 0, or not finite";
    if (!(fit.deviations[i] >= 0) || !std::isfinite(fit.deviations[i]))
      return "the deviation of ball " + std::to_string(i) + " is negative or not finite";
  }
  for (const double entry : fit.pose) {
    if (!std::isfinite(entry)) return "the pose is not finite";
  }
  for (const double number : {fit.residual, fit.expected, fit.mahalanobis, fit.noise}) {
    if (!(number >= 0) || !std::isfinite(number)) return "a distance is negative or not finite";
  }
  if (!(fit.outliers >= 0 && fit.outliers <= 1)) return "the part of outliers is not in [0, 1]";
  if (fit.observed < 0 || fit.iterations < 0 || fit.converged > 1) return "a count is negative";
  return {};
}

}  // namespace ballflow::geometry
