#include "io/strays.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t fewest_points = 16, share = 100;
constexpr double far_away = 10;  // diagonals

/// The values that are left between the `leave` lowest and the `leave` highest ones: least and greatest.
std::pair<double, double> inner_range(std::vector<double>& values, std::size_t leave) {
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(leave);
  const auto high = values.end() - static_cast<std::ptrdiff_t>(leave) - 1;
  std::nth_element(values.begin(), low, values.end());
  const double least = *low;
  std::nth_element(low, high, values.end());
  return {least, *high};
}

}  // namespace

Strays find_strays(std::span<const Vec3> points, std::span<const Triangle> triangles, Monitor& monitor) {
  Lookout look(monitor);
  Strays strays;
  if (points.size() < fewest_points) return strays;
  const std::size_t most = std::max<std::size_t>(1, points.size() / share);
  Vec3 low, high;
  std::vector<double> values(points.size());
  for (double Vec3::*const axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i].*axis;
    look(values.size());
    std::tie(low.*axis, high.*axis) = inner_range(values, most);
    look(16 * values.size());
  }
  const Vec3 middle = 0.5 * (low + high);
  strays.diagonal = distance(low, high);
  if (!(strays.diagonal > 0) || !std::isfinite(strays.diagonal)) return strays;
  std::vector<bool> is_far(points.size());
  look(points.size());
  bool any = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    is_far[i] = distance(points[i], middle) > far_away * strays.diagonal;
    any = any || is_far[i];
  }
  if (!any) return strays;
  if (!triangles.empty()) {
    // What is connected with a point that is not far away is none.
    DisjointSets parts(points.size());
    for (const Triangle& t : triangles) {
      look(16);
      parts.join(t[0], t[1]);
      parts.join(t[0], t[2]);
    }
    std::vector<bool> has_near(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!is_far[i]) has_near[static_cast<std::size_t>(parts.root(static_cast<std::int32_t>(i)))] = true;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (has_near[static_cast<std::size_t>(parts.root(static_cast<std::int32_t>(i)))]) is_far[i] = false;
    }
  }
  strays.nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_far[i]) continue;
    strays.points.push_back(static_cast<std::int32_t>(i));
    strays.nearest = std::min(strays.nearest, distance(points[i], middle));
  }
  if (strays.points.size() > most) strays.points.clear();
  return strays;
}

}  // namespace ballflow::geometry
