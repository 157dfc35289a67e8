#include "surface/surface_balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace ballflow::geometry {
namespace {

double radius_of(const SurfaceBallsOptions& options) {
  if (options.radius > 0) return options.radius;
  return std::clamp(0.56 + (options.shrink - 0.3) / 0.3 * 0.24, 0.56, 0.8);
}

void check(const SurfaceBallsOptions& options) {
  const auto require = [](bool right, const char* name, double value, const std::string& range) {
    if (!right) throw InputError(std::string(name) + " is " + std::to_string(value), range);
  };
  require(options.radius >= 0 && options.radius <= 2, "radius", options.radius, "use from 0 (chosen) to 2");
  const double radius = radius_of(options);
  require(options.shrink >= 0 && options.shrink <= radius, "shrink", options.shrink,
          "use from 0 to radius, which is " + std::to_string(radius) +
              ": shrunken balls are no larger than the balls themselves");
  require(options.floor >= 0 && options.floor <= 10, "floor", options.floor, "use from 0 to 10");
  require(options.smallest >= 0 && std::isfinite(options.smallest), "smallest", options.smallest,
          "use 0 or a length");
}

/// The largest rho_bar that Theorem 4.14 supports, from three computed values.
double proven_shrink(double radius) {
  constexpr std::array<std::pair<double, double>, 4> bounds{
      {{0.24, 0.020}, {0.30, 0.0315}, {0.35, 0.025}, {0.39, 0}}};
  for (std::size_t i = 1; i < bounds.size(); ++i) {
    const auto [low, at_low] = bounds[i - 1];
    const auto [high, at_high] = bounds[i];
    if (radius < low || radius > high) continue;
    return at_low + (radius - low) / (high - low) * (at_high - at_low);
  }
  return -1;
}

SurfaceRegime regime_of(double radius, double shrink, std::int64_t raised, bool fewer_poles) {
  if (raised > 0 || fewer_poles) return SurfaceRegime::heuristic;
  if (shrink <= proven_shrink(radius)) return SurfaceRegime::proven;
  if (radius >= 0.24 && radius <= 0.56 && shrink <= 0.6 * radius) return SurfaceRegime::supported;
  return SurfaceRegime::heuristic;
}

/// Where the spacing is as large as the features nothing tells noise, gaps and handles apart.
std::int64_t coarse_samples(const LocalFeatureSize& size, Monitor& monitor) {
  constexpr double coarse = 0.8;
  std::int64_t beyond = 0;
  for (std::size_t i = 0; i < size.points.size(); ++i) {
    if (size.third_neighbors[i] > coarse * size.pole_distances[i]) ++beyond;
  }
  if (2 * beyond > static_cast<std::int64_t>(size.points.size())) {
    monitor.warn("at " + std::to_string(beyond) + " of " + std::to_string(size.points.size()) +
                 " samples the third neighbour is about as far as the medial axis, or farther: the cloud is "
                 "too coarse "
                 "or too noisy for its features, so gaps may close and handles may come or go");
  }
  return beyond;
}

}  // namespace

SurfaceBalls surface_balls(const LocalFeatureSize& size, const SurfaceBallsOptions& options,
                           Monitor& monitor) {
  check(options);
  monitor.step(0);
  const std::size_t n = size.points.size();
  SurfaceBalls result;
  const double radius = radius_of(options);
  std::vector<double> radii(n), shrunk(n);
  std::vector<std::int64_t> offsets(n + 1);
  std::vector<std::int32_t> defining(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double wanted = radius * size.pole_distances[i];
    // Of fewer than four samples nobody knows the spacing.
    const double third = std::isfinite(size.third_neighbors[i]) ? size.third_neighbors[i] : 0;
    radii[i] = std::max({wanted, options.floor * third, options.smallest});
    if (radii[i] > wanted) ++result.report.raised;
    shrunk[i] = options.shrink / radius * radii[i];
    offsets[i + 1] = static_cast<std::int64_t>(i + 1);
    defining[i] = static_cast<std::int32_t>(i);
  }
  SurfaceBallsReport& report = result.report;
  report.radius = radius;
  report.shrink = options.shrink;
  report.regime =
      static_cast<std::uint8_t>(regime_of(radius, options.shrink, report.raised, size.fewer_poles != 0));
  report.samples = static_cast<std::int64_t>(n);
  report.coarse = coarse_samples(size, monitor);
  result.balls = {size.points, std::move(radii), std::move(offsets), std::move(defining)};
  result.shrunk = {size.points, std::move(shrunk), result.balls.defining_offsets,
                   result.balls.defining_samples};
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
