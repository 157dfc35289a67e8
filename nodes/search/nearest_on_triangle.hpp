// The point of a segment or a triangle next to a point, rounded.
#pragma once

#include <array>

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// A segment of length 0 is a point.
inline Vec3 nearest_on_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double squared = squared_length(ab);
  const double t = squared > 0 ? dot(p - a, ab) / squared : 0;
  if (!(t > 0)) return a;
  return t < 1 ? a + t * ab : b;
}

/// A triangle without area is its edges.
inline Vec3 nearest_on_triangle(Vec3 p, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vec3 normal = cross(b - a, c - a);
  const double squared = squared_length(normal);
  const auto left_of = [&](Vec3 from, Vec3 to) { return dot(cross(to - from, p - from), normal) >= 0; };
  if (squared > 0 && left_of(a, b) && left_of(b, c) && left_of(c, a)) {
    return p - (dot(p - a, normal) / squared) * normal;
  }
  Vec3 best = nearest_on_segment(p, a, b);
  for (const Vec3 q : {nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)}) {
    if (squared_distance(p, q) < squared_distance(p, best)) best = q;
  }
  return best;
}

}  // namespace ballflow::geometry
