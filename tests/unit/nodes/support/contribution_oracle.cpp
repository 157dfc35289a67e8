#include "contribution_oracle.hpp"

#include <optional>
#include <vector>

#include "exact_points.hpp"

namespace ballflow::geometry::test {
namespace {

struct Plane {
  Point n;
  Q b;  // the cell is n . y <= b
};

Point cross(const Point& a, const Point& b) {
  return {Q(a[1] * b[2] - a[2] * b[1]), Q(a[2] * b[0] - a[0] * b[2]), Q(a[0] * b[1] - a[1] * b[0])};
}
Point combine(const Q& s, const Point& a, const Q& t, const Point& b, const Q& u, const Point& c) {
  Point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = s * a[k] + t * b[k] + u * c[k];
  return p;
}

std::optional<Point> intersection(const Plane& a, const Plane& b, const Plane& c) {
  const Point bc = cross(b.n, c.n), ca = cross(c.n, a.n), ab = cross(a.n, b.n);
  const Q det = dot(a.n, bc);
  if (det == 0) return std::nullopt;
  return combine(Q(a.b / det), bc, Q(b.b / det), ca, Q(c.b / det), ab);
}

bool inside(const std::vector<Plane>& planes, const Point& y, bool strictly) {
  for (const Plane& plane : planes) {
    const Q value = dot(plane.n, y);
    if (strictly ? value >= plane.b : value > plane.b) return false;
  }
  return true;
}

}  // namespace

bool contributes_by_enumeration(const Site& site, std::span<const Site> others) {
  std::vector<Plane> planes;
  Q reach = 1 + Q(site.weight);
  for (const Site& other : others) {
    const Point d{Q(other.center.x) - Q(site.center.x), Q(other.center.y) - Q(site.center.y),
                  Q(other.center.z) - Q(site.center.z)};
    const Q b = (dot(d, d) - Q(other.weight) + Q(site.weight)) / 2;
    if (is_zero(d)) {
      if (b <= 0) return false;
      continue;
    }
    planes.push_back({d, b});
    reach += dot(d, d) + Q(other.weight);
  }
  const Q weight(site.weight);
  const Point origin{Q(0), Q(0), Q(0)};
  if (inside(planes, origin, true)) return true;
  if (weight == 0) return false;
  // The ball is inside the box: a cell that meets the ball is cut, not lost.
  const std::size_t own = planes.size();
  for (std::size_t k = 0; k < 3; ++k) {
    for (const int sign : {-1, 1}) {
      Point n = origin;
      n[k] = sign;
      planes.push_back({n, reach});
    }
  }
  Point sum = origin;
  long vertices = 0;
  std::optional<Q> nearest;
  const auto consider = [&](const Point& y) {
    const Q squared = dot(y, y);
    if ((!nearest || squared < *nearest) && inside(planes, y, false)) nearest = squared;
  };
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const auto y = intersection(planes[i], planes[j], planes[k]);
        if (!y || !inside(planes, *y, false)) continue;
        sum = combine(Q(1), sum, Q(1), *y, Q(0), origin);
        ++vertices;
        consider(*y);
      }
    }
  }
  if (vertices == 0) return false;
  if (!inside(planes, combine(Q(Q(1) / vertices), sum, Q(0), origin, Q(0), origin), true)) return false;
  consider(origin);
  for (std::size_t i = 0; i < own; ++i) {
    const Plane& a = planes[i];
    const Q aa = dot(a.n, a.n);
    consider(combine(Q(a.b / aa), a.n, Q(0), origin, Q(0), origin));
    for (std::size_t j = 0; j < i; ++j) {
      // The plane through the origin across the line of two planes.
      const Plane& b = planes[j];
      const Plane across{cross(a.n, b.n), Q(0)};
      if (const auto y = intersection(a, b, across)) consider(*y);
    }
  }
  return nearest && *nearest < weight;
}

}  // namespace ballflow::geometry::test
