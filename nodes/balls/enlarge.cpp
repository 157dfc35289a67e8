#include "balls/enlarge.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "types/monitor.hpp"

namespace ballflow::geometry {
namespace {

double additive_growth(const Box& sample_box, double percent) {
  if (sample_box.empty()) {
    throw InputError("mode additive needs the sample, which is absent or empty",
                     "connect the points the balls were made from, or use mode absolute or multiplicative");
  }
  return percent / 100 * sample_box.longest_edge();
}

void check(const EnlargeOptions& options) {
  const bool multiplies = options.mode == EnlargeMode::multiplicative;
  if (!multiplies && !(options.epsilon >= 0 && std::isfinite(options.epsilon))) {
    throw InputError("epsilon is " + std::to_string(options.epsilon),
                     "balls only grow: use a finite epsilon >= 0");
  }
  if (multiplies && !(options.factor >= 1 && std::isfinite(options.factor))) {
    throw InputError("factor is " + std::to_string(options.factor),
                     "balls only grow: use a finite factor >= 1");
  }
}

}  // namespace

Balls enlarge(const Balls& balls, const Box& sample_box, const EnlargeOptions& options) {
  check(options);
  if (const std::string broken = broken_invariant(balls); !broken.empty()) {
    throw InputError(broken, "repair or remove the ball before enlarging");
  }
  double factor = 1, summand = 0;
  switch (options.mode) {
    case EnlargeMode::additive:
      summand = additive_growth(sample_box, options.epsilon);
      break;
    case EnlargeMode::absolute:
      summand = options.epsilon;
      break;
    case EnlargeMode::multiplicative:
      factor = options.factor;
      break;
  }
  std::vector<double> radii;
  radii.reserve(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    radii.push_back(factor * balls.radii[i] + summand);
    if (!std::isfinite(radii.back())) {
      throw InputError("the enlarged radius of ball " + std::to_string(i) + " is beyond the range of doubles",
                       "enlarge less, or scale the model down");
    }
  }
  Balls enlarged = balls;
  enlarged.radii = std::move(radii);
  return enlarged;
}

}  // namespace ballflow::geometry
