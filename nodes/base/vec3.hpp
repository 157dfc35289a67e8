// Points and vectors in space. Coordinates are doubles in model units; decisions that depend on their
// exact values are taken by CGAL's exact predicates, not by these operators.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace ballflow::geometry {

struct Vec3 {
  double x = 0, y = 0, z = 0;

  using scalar = double;  // how an array of Vec3 is stored: n x 3 doubles
  static constexpr std::size_t dimension = 3;

  friend bool operator==(const Vec3&, const Vec3&) = default;
  friend auto operator<=>(const Vec3&, const Vec3&) = default;
  friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
};

inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double squared_length(Vec3 a) { return dot(a, a); }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline double squared_distance(Vec3 a, Vec3 b) { return squared_length(a - b); }
inline double distance(Vec3 a, Vec3 b) { return length(a - b); }
inline bool is_finite(Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// Axis-aligned bounding box; empty (lower > upper) for no points.
struct Box {
  Vec3 lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
  Vec3 upper{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};

  bool empty() const { return lower.x > upper.x; }
  void add(Vec3 p) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
  }
  /// Length of the longest edge: the unit of every "% of the bounding box" parameter (thesis, 3.9.2).
  double longest_edge() const {
    if (empty()) return 0;
    return std::max({upper.x - lower.x, upper.y - lower.y, upper.z - lower.z});
  }
};

inline Box bounding_box(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& p : points) box.add(p);
  return box;
}

}  // namespace ballflow::geometry
