#include "power/contribution.hpp"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "exact/nearest_point.hpp"

namespace ballflow::geometry {
namespace {

using Rational = CGAL::Exact_rational;

/// real + slope * t for an infinitesimal t > 0.
struct Perturbed {
  Rational real = 0, slope = 0;

  friend Perturbed operator+(const Perturbed& a, const Perturbed& b) {
    return {a.real + b.real, a.slope + b.slope};
  }
  friend Perturbed operator-(const Perturbed& a, const Perturbed& b) {
    return {a.real - b.real, a.slope - b.slope};
  }
  friend Perturbed operator*(const Perturbed& a, const Rational& f) { return {a.real * f, a.slope * f}; }
  friend Perturbed operator/(const Perturbed& a, const Rational& f) { return {a.real / f, a.slope / f}; }
  friend bool operator<(const Perturbed& a, const Perturbed& b) {
    return a.real < b.real || (a.real == b.real && a.slope < b.slope);
  }
};

// Relative to |d|^2 + w_j + w. Rounding errors of what is computed below stay under 2^-49 of it, in any
// rounding mode under 2^-48; numbers so small that products underflow are left to exact arithmetic.
constexpr double rounding = 0x1p-46, margin = 0x1p-36, smallest_scale = 1e-290;

/// Multipliers >= 0 with y = -(sum of multiplier * normal), the largest 1; zeros when there are none.
std::array<double, 3> multipliers(const std::array<Vec3, 3>& d, int count, Vec3 y) {
  std::array<double, 3> m{1, 0, 0};
  if (count == 2) {
    const double aa = dot(d[0], d[0]), ab = dot(d[0], d[1]), bb = dot(d[1], d[1]);
    const double ay = -dot(d[0], y), by = -dot(d[1], y);
    m = {ay * bb - by * ab, by * aa - ay * ab, 0};  // times the determinant, which is positive
  } else if (count == 3) {
    const Vec3 bc = cross(d[1], d[2]), ca = cross(d[2], d[0]), ab = cross(d[0], d[1]);
    const double sign = dot(d[0], bc) < 0 ? 1 : -1;
    m = {sign * dot(y, bc), sign * dot(y, ca), sign * dot(y, ab)};
  }
  double largest = 0;
  for (double& value : m) {
    value = std::max(value, 0.0);
    largest = std::max(largest, value);
  }
  if (!(largest > 0)) return {};
  for (double& value : m) value /= largest;
  return m;
}

}  // namespace

bool ContributionTest::contributes(const Site& site, std::span<const Site> others) {
  const Answer answer = filtered(site, others);
  if (answer != Answer::unknown) return answer == Answer::yes;
  ++exact_;
  return exact(site, others);
}

ContributionTest::Answer ContributionTest::filtered(const Site& site, std::span<const Site> others) {
  const double w = site.weight, radius = std::sqrt(w);
  half_spaces_.clear();
  double largest_violation = 0;
  bool center_outside = false, center_inside = true;  // certainly
  for (const Site& other : others) {
    const Vec3 d = other.center - site.center;
    if (d == Vec3{}) {
      if (other.weight >= w) return Answer::no;
      continue;
    }
    const double dd = dot(d, d), scale = dd + other.weight + w;
    if (!(scale >= smallest_scale)) return Answer::unknown;
    const double b = (dd - other.weight + w) / 2, error = rounding * scale;
    half_spaces_.push_back({d, b, margin * scale});
    if (b > error) continue;
    center_inside = false;
    if (b > -error) continue;
    center_outside = true;
    const double norm = std::sqrt(dd);
    if (b + radius * norm < -error) return Answer::no;  // beyond this plane is the whole ball
    if (b / norm < largest_violation) {
      largest_violation = b / norm;
      std::swap(half_spaces_.front(), half_spaces_.back());  // planes that cut much off come first
    }
  }
  if (center_inside) return Answer::yes;
  if (w == 0) return center_outside ? Answer::no : Answer::unknown;

  using Nearest = NearestPoint<double, double>;
  const Nearest nearest(
      half_spaces_.size(),
      [&](std::size_t j) {
        const Vec3 d = half_spaces_[j].d;
        return Nearest::Normal{d.x, d.y, d.z};
      },
      [&](std::size_t j) { return half_spaces_[j].b - half_spaces_[j].margin; },
      [&](const Nearest::Point& p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2] > w * (1 + 0x1p-20); });
  if (nearest.status == Nearest::Status::empty) return Answer::unknown;
  const Vec3 y{nearest.point[0], nearest.point[1], nearest.point[2]};
  const double error = rounding / margin;  // times the margin
  if (dot(y, y) < w * (1 - rounding)) {
    for (const HalfSpace& h : half_spaces_) {
      if (!(dot(h.d, y) < h.b - error * h.margin)) return Answer::unknown;
    }
    return Answer::yes;
  }
  // For y in the ball and the cell, sum of m_j (d_j . y) < sum of m_j b_j, and the left side is at least
  // -radius |sum of m_j d_j|.
  std::array<Vec3, 3> normals;
  for (std::size_t k = 0; k < 3; ++k) normals[k] = half_spaces_[nearest.active[k]].d;
  const std::array<double, 3> m = multipliers(normals, nearest.active_count, y);
  Vec3 normal;
  double bound = 0, doubt = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const HalfSpace& h = half_spaces_[nearest.active[k]];
    normal = normal + m[k] * h.d;
    bound += m[k] * h.b;
    doubt += m[k] * (4 * error * h.margin);
  }
  return bound + radius * length(normal) < -doubt ? Answer::no : Answer::unknown;
}

bool ContributionTest::exact(const Site& site, std::span<const Site> others) {
  using Nearest = NearestPoint<Rational, Perturbed>;
  std::vector<Nearest::Normal> normals;
  std::vector<Perturbed> bounds;
  bool center_inside = true;
  for (const Site& other : others) {
    const Rational x = Rational(other.center.x) - Rational(site.center.x),
                   y = Rational(other.center.y) - Rational(site.center.y),
                   z = Rational(other.center.z) - Rational(site.center.z);
    const Rational b = (x * x + y * y + z * z - Rational(other.weight) + Rational(site.weight)) / Rational(2);
    normals.push_back({x, y, z});
    bounds.push_back({b, Rational(-1)});
    center_inside = center_inside && b > 0;
  }
  if (center_inside) return true;
  if (site.weight == 0) return false;
  const Rational weight(site.weight);
  const auto squared = [](const Nearest::Point& p) {
    return Rational(p[0].real * p[0].real + p[1].real * p[1].real + p[2].real * p[2].real);
  };
  const Nearest nearest(
      normals.size(), [&](std::size_t j) -> const Nearest::Normal& { return normals[j]; },
      [&](std::size_t j) -> const Perturbed& { return bounds[j]; },
      [&](const Nearest::Point& p) { return squared(p) >= weight; });
  // On the sphere for t = 0 it is outside for t > 0: the smaller the set, the farther its nearest point.
  return nearest.status == Nearest::Status::found && squared(nearest.point) < weight;
}

}  // namespace ballflow::geometry
