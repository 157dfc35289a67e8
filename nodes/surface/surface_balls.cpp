#include "surface/surface_balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "power/union_vertices.hpp"

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
  require(options.uneven_floor >= 0 && options.uneven_floor <= 10, "uneven_floor", options.uneven_floor,
          "use from 0 to 10");
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

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Coarse {
  std::int64_t samples = 0;  // where the spacing is as large as the features
  std::int64_t sparse = 0;   // of these, where it is twice as large as elsewhere, too
  std::size_t worst = 0;     // the sparsest of them
  bool in_part = false;      // part of the cloud is too thin, and not all of it
};

Coarse coarse_samples(const LocalFeatureSize& size) {
  // Of even clouds, also coarse ones, at most 1.5 % of the samples are sparse; of those that were thinned out
  // to one in ten at one end, and lost a handle there, from 2.3 % on.
  constexpr double coarse = 0.8, sparse = 2, share = 0.02;
  const double median =
      median_of(std::vector<double>(size.third_neighbors.begin(), size.third_neighbors.end()));
  Coarse found;
  for (std::size_t i = 0; i < size.points.size(); ++i) {
    const double third = size.third_neighbors[i];
    if (!(third > coarse * size.pole_distances[i])) continue;
    ++found.samples;
    if (!(third > sparse * median)) continue;
    const double most = size.third_neighbors[found.worst];
    if (found.sparse++ == 0 || third > most ||
        (third == most && before(size.points[i], size.points[found.worst])))
      found.worst = i;
  }
  const auto n = static_cast<double>(size.points.size());
  found.in_part =
      static_cast<double>(found.sparse) > share * n && 2 * static_cast<double>(found.samples) <= n;
  return found;
}

/// Where the spacing is as large as the features nothing tells noise, gaps and handles apart.
void warn(const Coarse& coarse, const LocalFeatureSize& size, Monitor& monitor) {
  const std::string all = std::to_string(size.points.size());
  if (coarse.in_part) {
    char place[96];
    const Vec3 p = size.points[coarse.worst];
    std::snprintf(place, sizeof place, "(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
    monitor.warn(
        "at " + std::to_string(coarse.sparse) + " of " + all + " samples, around " + place +
        ", the cloud is twice as coarse as elsewhere, and too coarse for its features: thin parts may "
        "break there, holes close, and the genus may be wrong");
  }
  if (2 * coarse.samples > static_cast<std::int64_t>(size.points.size())) {
    monitor.warn("at " + std::to_string(coarse.samples) + " of " + all +
                 " samples the third neighbour is about as far as the medial axis, or farther: the cloud is "
                 "too coarse "
                 "or too noisy for its features, so gaps may close and handles may come or go");
  }
}

}  // namespace

SurfaceBalls surface_balls(const LocalFeatureSize& size, const SurfaceBallsOptions& options,
                           Monitor& monitor) {
  check(options);
  monitor.step(0);
  const std::size_t n = size.points.size();
  SurfaceBalls result;
  const double radius = radius_of(options);
  const Coarse coarse = coarse_samples(size);
  const double floor = coarse.in_part ? std::max(options.floor, options.uneven_floor) : options.floor;
  std::vector<double> radii(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double wanted = radius * size.pole_distances[i];
    // Of fewer than four samples nobody knows the spacing.
    const double third = std::isfinite(size.third_neighbors[i]) ? size.third_neighbors[i] : 0;
    radii[i] = std::max({wanted, floor * third, options.smallest});
    if (radii[i] > wanted) ++result.report.raised;
  }
  std::vector<std::int32_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  if (options.by_place) {
    // Not by size, which is rounded.
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return before(size.points[static_cast<std::size_t>(a)], size.points[static_cast<std::size_t>(b)]);
    });
  }
  SurfaceBallsReport& report = result.report;
  report.radius = radius;
  report.shrink = options.shrink;
  report.regime =
      static_cast<std::uint8_t>(regime_of(radius, options.shrink, report.raised, size.fewer_poles != 0));
  report.samples = static_cast<std::int64_t>(n);
  report.coarse = coarse.samples;
  warn(coarse, size, monitor);
  std::vector<Vec3> centers;
  std::vector<double> ordered, shrunk;
  std::vector<std::int64_t> offsets(n + 1);
  for (std::size_t k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(order[k]);
    centers.push_back(size.points[i]);
    ordered.push_back(radii[i]);
    shrunk.push_back(options.shrink / radius * radii[i]);
    offsets[k + 1] = static_cast<std::int64_t>(k + 1);
  }
  std::vector<std::int32_t> places(n);
  std::iota(places.begin(), places.end(), 0);
  result.points = {std::move(centers), {}};
  result.balls = {result.points.points, std::move(ordered), std::move(offsets), std::move(order)};
  result.shrunk = {result.points.points, std::move(shrunk), result.balls.defining_offsets, std::move(places)};
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
