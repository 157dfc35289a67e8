#include "search/ellipsoid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ballflow::geometry {

double Ellipsoid::signed_distance(Vec3 p) const {
  const Vec3 v = frame_.into(p - center_);
  // By symmetry in the octant of positive coordinates; the half-axes descend.
  std::array<std::pair<double, double>, 3> order{
      std::pair{radii_.x, std::abs(v.x)}, {radii_.y, std::abs(v.y)}, {radii_.z, std::abs(v.z)}};
  if (order[0].first < order[1].first) std::swap(order[0], order[1]);
  if (order[1].first < order[2].first) std::swap(order[1], order[2]);
  if (order[0].first < order[1].first) std::swap(order[0], order[1]);
  const double a = order[2].first;
  std::array<double, 3> z{}, r{}, gap{};  // coordinates and squared half-axes in units of a; r - 1
  for (std::size_t i = 0; i < 3; ++i) {
    const double e = order[i].first / a;
    r[i] = e * e;
    gap[i] = (e - 1) * (e + 1);
    // A point in a plane of symmetry is moved off it by less than the error allowed: there the root is 0,
    // and the nearest points are two.
    z[i] = std::max(order[i].second / a, 0x1p-44 * e);
  }
  double inside = 0;
  for (std::size_t i = 0; i < 3; ++i) inside += z[i] * z[i] / r[i];
  // Every term alone is at most 1 at the root.
  double u = 0;
  for (std::size_t i = 0; i < 3; ++i) u = std::max(u, std::sqrt(r[i]) * z[i] - gap[i]);
  for (int step = 0; step < 100; ++step) {
    double sum = 0, slope = 0;  // of the squared terms, and minus half its derivative
    for (std::size_t i = 0; i < 3; ++i) {
      const double q = std::sqrt(r[i]) * z[i] / (u + gap[i]), square = q * q;
      sum += square;
      slope += square / (u + gap[i]);
    }
    const double next = u + sum * (std::sqrt(sum) - 1) / slope;
    const bool still = !(next > u * (1 + 0x1p-51));
    u = std::max(u, next);
    if (still) break;
  }
  double squared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    // z - r z / (u + gap) = z (u - 1) / (u + gap), since gap = r - 1.
    const double away = z[i] * (u - 1) / (u + gap[i]);
    squared += away * away;
  }
  const double distance = a * std::sqrt(squared);
  return inside < 1 ? -distance : distance;
}

}  // namespace ballflow::geometry
