// A model of a shape fitted to an observation of a part of it.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// The posterior of scores and pose of a ShapePrior with q modes and k balls, given an observation.
struct ShapeFit {
  Array<double> scores;      // q: posterior mean, standard deviations of the prior
  Array<double> covariance;  // q q: posterior, the same units; the identity where nothing was learned
  std::array<double, 12> pose{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // 3 x 4 by rows: from the model to the
                                                                    // coordinates of the observation
  Array<Vec3> centers;       // k x 3: of the fitted shape, coordinates of the observation
  Array<double> radii;       // k, above 0
  Array<double> deviations;  // k: how uncertain the place of a ball is, root of the mean squared displacement
                             // of its center, model units

  // How far the observation is from the model.
  double residual = 0;     // root mean square distance of what was explained from the shape, model units
  double expected = 0;     // the same of an instance that the model does not know: ShapePrior::generalization
  double outliers = 0;     // part of the observation that is explained by no part of the shape, in [0, 1]
  double mahalanobis = 0;  // root of the mean of the squared scores: about 1 for instances, 0 for the mean
  double noise = 0;        // width of the distribution around the shape at the end, model units
  std::int64_t observed = 0;  // points or balls
  std::int32_t iterations = 0;
  std::uint8_t converged = 0;
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const ShapeFit& fit);

}  // namespace ballflow::geometry
