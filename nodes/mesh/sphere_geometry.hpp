// Triangles below a sphere, and the stereographic projection.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vec3.hpp"

namespace ballflow::geometry {

inline double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double l = squared_length(d);
  const double t = l > 0 ? std::clamp(dot(p - a, d) / l, 0.0, 1.0) : 0.0;
  return distance(p, a + t * d);
}

inline double distance_to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = cross(b - a, c - a);
  const bool over = dot(cross(b - a, n), p - a) <= 0 && dot(cross(c - b, n), p - b) <= 0 &&
                    dot(cross(a - c, n), p - c) <= 0;
  if (over && squared_length(n) > 0) return std::abs(dot(n, p - a)) / length(n);
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

/// A sphere and the plane it is projected to.
struct Projection {
  Projection(Vec3 center, double radius, Vec3 pole) : c(center), r(radius), up(pole) {
    const double x = std::abs(up.x), y = std::abs(up.y), z = std::abs(up.z);
    const Vec3 least = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    const Vec3 v = least - dot(least, up) * up;
    right = 1 / length(v) * v;
    ahead = cross(up, right);
  }
  std::array<double, 2> plane(Vec3 p) const {
    const Vec3 n = p - c;
    const double s = 1 / (length(n) - dot(n, up));
    return {s * dot(n, right), s * dot(n, ahead)};
  }
  Vec3 sphere(double x, double y) const {
    const double s = x * x + y * y, t = 1 / (s + 1);
    const Vec3 n = ((2 * x * t) * right + (2 * y * t) * ahead) + ((s - 1) * t) * up;
    return c + (r / length(n)) * n;
  }

  Vec3 c;
  double r;
  Vec3 up, right, ahead;
};

}  // namespace ballflow::geometry
