#include "power/alpha_shape.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "power/alpha_classes.hpp"
#include "power/regular_cells.hpp"

namespace ballflow::geometry {
namespace {

double tolerance(const Balls& balls, AlphaTolerance kind) {
  if (kind == AlphaTolerance::none) return 0;
  const double edge = bounding_box(balls).longest_edge();
  return std::ldexp(edge * edge, -36);
}

}  // namespace

std::vector<double> ball_weights(const Balls& balls, AlphaTolerance kind) {
  if (const std::string broken = broken_invariant(balls); !broken.empty()) {
    throw InputError(broken, "repair or remove the ball before computing the alpha-shape");
  }
  if (balls.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw InputError(std::to_string(balls.size()) + " balls, but indices have 31 bits",
                     "prune the balls first");
  }
  const double delta = tolerance(balls, kind);
  std::vector<double> weights;
  weights.reserve(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    weights.push_back(balls.radii[i] * balls.radii[i] + delta);
    if (!std::isfinite(weights.back())) {
      throw InputError("the squared radius of ball " + std::to_string(i) +
                           " is too large for a double (radius " + std::to_string(balls.radii[i]) + ")",
                       "scale the model so that its coordinates are below 1e150");
    }
  }
  return weights;
}

SimplicialComplex alpha_shape(const Balls& balls, const AlphaShapeOptions& options, Monitor& monitor) {
  const Array<double> weights(ball_weights(balls, options.tolerance));
  PartMonitor triangulating(monitor, 0, 0.6);
  const RegularCells cells = regular_cells(balls.centers, weights, triangulating);
  PartMonitor classifying(monitor, 0.6, 1);
  SimplicialComplex complex = alpha_classes(cells, balls.centers, weights, classifying);
  complex.delta = tolerance(balls, options.tolerance);
  monitor.step(1);
  return complex;
}

}  // namespace ballflow::geometry
