#include "exact/circumcenter.hpp"

#include <CGAL/Exact_rational.h>

#include <cstddef>
#include <type_traits>

namespace ballflow::geometry {
namespace {

/// With Number = double: false when the tetrahedron is so flat that cancellation may have spoilt the result.
template <class Number>
bool circumcenter(const std::array<Vec3, 4>& p, Vec3& out) {
  struct V {
    Number x, y, z;
  };
  const auto edge = [&p](std::size_t k) {
    return V{Number(p[k].x) - Number(p[0].x), Number(p[k].y) - Number(p[0].y),
             Number(p[k].z) - Number(p[0].z)};
  };
  const auto cross_of = [](const V& a, const V& b) {
    return V{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const auto dot_of = [](const V& a, const V& b) -> Number { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const V a = edge(1), b = edge(2), c = edge(3);
  const V ab = cross_of(a, b), bc = cross_of(b, c), ca = cross_of(c, a);
  const Number aa = dot_of(a, a), bb = dot_of(b, b), cc = dot_of(c, c);
  const Number det = dot_of(a, bc);
  if constexpr (std::is_same_v<Number, double>) {
    constexpr double flat = 1e-3;  // errors stay below some 1e-12 of the size of the tetrahedron
    if (!(det * det > flat * flat * aa * bb * cc)) return false;
  }
  const Number scale = Number(2) * det;
  const auto along = [&](const Number& x, const Number& y, const Number& z) {
    return CGAL::to_double(Number((aa * x + bb * y + cc * z) / scale));
  };
  out = p[0] + Vec3{along(bc.x, ca.x, ab.x), along(bc.y, ca.y, ab.y), along(bc.z, ca.z, ab.z)};
  return true;
}

/// With Number = double: false when the triangle is so flat that cancellation may have spoilt the result.
template <class Number>
bool circumcenter(const std::array<Vec2, 3>& p, Vec2& out) {
  const Number ax = Number(p[1].x) - Number(p[0].x), ay = Number(p[1].y) - Number(p[0].y),
               bx = Number(p[2].x) - Number(p[0].x), by = Number(p[2].y) - Number(p[0].y);
  const Number aa = ax * ax + ay * ay, bb = bx * bx + by * by, det = ax * by - ay * bx;
  if constexpr (std::is_same_v<Number, double>) {
    constexpr double flat = 1e-3;
    if (!(det * det > flat * flat * aa * bb)) return false;
  }
  const Number scale = Number(2) * det;
  out = p[0] + Vec2{CGAL::to_double(Number((aa * by - bb * ay) / scale)),
                    CGAL::to_double(Number((bb * ax - aa * bx) / scale))};
  return true;
}

}  // namespace

Vec2 circumcenter(const std::array<Vec2, 3>& points) {
  Vec2 center;
  if (!circumcenter<double>(points, center)) circumcenter<CGAL::Exact_rational>(points, center);
  return center;
}

Vec3 circumcenter(const std::array<Vec3, 4>& points) {
  Vec3 center;
  if (!circumcenter<double>(points, center)) circumcenter<CGAL::Exact_rational>(points, center);
  return center;
}

}  // namespace ballflow::geometry
