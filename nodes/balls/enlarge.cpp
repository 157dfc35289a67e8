#include "balls/enlarge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "search/local_feature_size.hpp"

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string name(EnlargeMode mode) {
  switch (mode) {
    case EnlargeMode::additive:
      return "additive";
    case EnlargeMode::absolute:
      return "absolute";
    case EnlargeMode::multiplicative:
      return "multiplicative";
    case EnlargeMode::pole_bound:
      return "pole_bound";
    case EnlargeMode::power_diagram:
      return "power_diagram";
  }
  return {};
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

/// The radii that are asked for.
std::vector<double> wished_radii(const Balls& balls, const PointSet& sample, const EnlargeOptions& options) {
  double factor = 1, summand = 0;
  if (options.mode == EnlargeMode::absolute) {
    summand = options.epsilon;
  } else if (options.mode == EnlargeMode::multiplicative) {
    factor = options.factor;
  } else {
    if (sample.points.empty()) {
      throw InputError("mode " + name(options.mode) + " needs the sample, which is absent or empty",
                       "connect the points the balls were made from, or use mode absolute or multiplicative");
    }
    summand = options.epsilon / 100 * bounding_box(sample.points.span()).longest_edge();
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
  return radii;
}

}  // namespace

EnlargeOptions searched(EnlargeOptions options, const Bisection& search) {
  if (options.mode == EnlargeMode::multiplicative) {
    throw InputError("a search is connected, but mode multiplicative does not use epsilon",
                     "search with another mode, such as additive");
  }
  options.epsilon = search.value;
  return options;
}

Enlarged enlarge(const Balls& balls, const PointSet& sample, const PoleSet& poles,
                 const EnlargeOptions& options, Monitor& monitor, const PowerDiagram* diagram) {
  check(options);
  if (const std::string broken = broken_invariant(balls); !broken.empty()) {
    throw InputError(broken, "repair or remove the ball before enlarging");
  }
  if (options.mode == EnlargeMode::pole_bound && poles.size() == 0) {
    throw InputError("mode pole_bound needs the poles of the sample, which are absent or none",
                     "connect the output poles of LabelPoles or VoronoiPoles");
  }
  std::vector<double> radii = wished_radii(balls, sample, options);
  std::vector<double> limits(balls.size(), infinity);
  std::vector<std::uint8_t> stops(balls.size(), static_cast<std::uint8_t>(GrowthStop::wish));
  Enlarged result;
  if (options.mode == EnlargeMode::pole_bound) {
    PartMonitor measuring(monitor, 0, 0.5), bounding(monitor, 0.5, 1);
    const LocalFeatureSize sizes = local_feature_size(sample, poles, measuring);
    limits = pole_bounds(balls, sizes, radii, options.pole_bound, bounding);
    for (std::size_t i = 0; i < balls.size(); ++i) {
      if (!(limits[i] < radii[i])) continue;
      radii[i] = std::max(balls.radii[i], limits[i]);
      stops[i] = static_cast<std::uint8_t>(GrowthStop::poles);
    }
  } else if (options.mode == EnlargeMode::power_diagram) {
    PowerGrowth grown = power_growth(balls, radii, options.power_diagram, monitor, diagram);
    radii = std::move(grown.radii);
    limits = std::move(grown.limits);
    stops = std::move(grown.stops);
    result.growth.betti_before = grown.betti_before;
    result.growth.betti_after = grown.betti_after;
    result.unions = grown.unions;
  }
  result.balls = balls;
  result.balls.radii = std::move(radii);
  result.growth.centers = balls.centers;
  result.growth.radii = balls.radii;
  result.growth.grown_radii = result.balls.radii;
  result.growth.limits = std::move(limits);
  result.growth.stops = std::move(stops);
  return result;
}

}  // namespace ballflow::geometry
