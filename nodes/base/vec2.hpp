// Points and vectors in the plane; see vec3.hpp.
#pragma once

#include <cmath>
#include <cstddef>

#include "base/vec3.hpp"

namespace ballflow::geometry {

struct Vec2 {
  double x = 0, y = 0;

  using scalar = double;  // how an array of Vec2 is stored: n x 2 doubles
  static constexpr std::size_t dimension = 2;

  friend bool operator==(const Vec2&, const Vec2&) = default;
  friend auto operator<=>(const Vec2&, const Vec2&) = default;
  friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
};

inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// Twice the signed area of the triangle 0, a, b.
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double squared_length(Vec2 a) { return dot(a, a); }
inline double length(Vec2 a) { return std::sqrt(dot(a, a)); }
inline double distance(Vec2 a, Vec2 b) { return length(a - b); }
inline bool is_finite(Vec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); }

/// The plane of planar shapes is z = 0.
inline Vec3 in_space(Vec2 p) { return {p.x, p.y, 0}; }

}  // namespace ballflow::geometry
