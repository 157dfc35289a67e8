#include "refine/narrow_ends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ballflow::geometry {

void add_rings(Vec3 end, const Balls& inner, double enough, double least, const SurfaceTree& surface,
               std::vector<SurfacePoint>& points) {
  double away = std::numeric_limits<double>::infinity();
  std::size_t next = 0;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const double d = distance(end, inner.centers[i]) - inner.radii[i];
    if (d >= away) continue;
    away = d;
    next = i;
  }
  if (inner.size() == 0 || away <= enough) return;
  const Vec3 axis = 1 / (away + inner.radii[next]) * (inner.centers[next] - end);
  const Vec3 across = std::abs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = 1 / length(cross(axis, across)) * cross(axis, across), v = cross(axis, u);
  constexpr std::array<std::pair<int, int>, 8> around{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  constexpr int most_rings = 64;
  double from_end = away;
  for (int ring = 0; ring < most_rings && from_end > enough / 2; ++ring) {
    const Vec3 middle = end + from_end * axis;
    double narrow = away / 4;
    for (const auto& [a, b] : around) {
      const Vec3 direction = a * u + b * v;
      const auto hit = surface.first_hit(middle, direction, 0, 2 * away);
      if (!hit || dot(surface.normal(hit->triangle), direction) <= 0) continue;  // from outside
      narrow = std::min(narrow, distance(hit->point, middle));
      points.push_back(*hit);
    }
    from_end -= std::max(narrow, least);
  }
}

}  // namespace ballflow::geometry
