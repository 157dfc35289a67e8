#include "show/picture/intersect.hpp"

#include <algorithm>
#include <cmath>

namespace ballflow::show {

using geometry::cross;
using geometry::dot;
using geometry::squared_length;
using geometry::Vec3;

double Capsule::place(Vec3 p) const {
  const Vec3 axis = b - a;
  const double squared = squared_length(axis);
  return squared > 0 ? std::clamp(dot(p - a, axis) / squared, 0.0, 1.0) : 0;
}

std::optional<Interval> inside(const Ray& ray, const Ball& ball) {
  const Vec3 to_center = ball.center - ray.origin;
  const double middle = dot(to_center, ray.direction);
  // The foot of the perpendicular, so that small balls far away lose no digits.
  const Vec3 off = to_center - middle * ray.direction;
  const double quarter_chord = ball.radius * ball.radius - squared_length(off);
  if (!(quarter_chord > 0)) return std::nullopt;
  const double half = std::sqrt(quarter_chord);
  return Interval{middle - half, middle + half};
}

std::optional<double> entry(const Ray& ray, const Capsule& capsule) {
  const Vec3 axis = capsule.b - capsule.a;
  const double squared = squared_length(axis);
  const auto cap = [&](Vec3 end) -> std::optional<double> {
    const auto part = inside(ray, {end, capsule.radius});
    if (!part) return std::nullopt;
    return part->lower;
  };
  std::optional<double> first = cap(capsule.a);
  if (!(squared > 0)) return first;
  if (const auto other = cap(capsule.b); other && (!first || *other < *first)) first = other;

  // The infinite cylinder, from the point of the ray that is nearest to the middle of the segment.
  const double shift = dot(0.5 * (capsule.a + capsule.b) - ray.origin, ray.direction);
  const Vec3 from_a = ray.at(shift) - capsule.a;
  const double along = dot(axis, ray.direction), across = dot(axis, from_a);
  const double a = squared - along * along;
  if (!(a > 1e-12 * squared)) return first;  // seen along its axis: only an end is visible
  const double half_b = squared * dot(from_a, ray.direction) - across * along;
  const double c =
      squared * squared_length(from_a) - across * across - capsule.radius * capsule.radius * squared;
  const double discriminant = half_b * half_b - a * c;
  if (!(discriminant > 0)) return first;
  const double t = (-half_b - std::sqrt(discriminant)) / a;
  const double height = across + t * along;
  if (height < 0 || height > squared) return first;
  return first ? std::min(*first, shift + t) : shift + t;
}

std::optional<TriangleHit> meeting(const Ray& ray, const Triangle3& triangle) {
  const Vec3 a = triangle.a - ray.origin, b = triangle.b - ray.origin, c = triangle.c - ray.origin;
  // The side of an edge on which the ray passes: exchanging the ends exactly changes the sign, so the two
  // triangles of an edge agree.
  const double of_a = dot(ray.direction, cross(b, c));
  const double of_b = dot(ray.direction, cross(c, a));
  const double of_c = dot(ray.direction, cross(a, b));
  const bool front = of_a >= 0 && of_b >= 0 && of_c >= 0;
  const bool back = of_a <= 0 && of_b <= 0 && of_c <= 0;
  if (!front && !back) return std::nullopt;
  const double sum = of_a + of_b + of_c;
  if (sum == 0) return std::nullopt;
  const double wa = of_a / sum, wb = of_b / sum, wc = of_c / sum;
  return TriangleHit{dot(wa * a + wb * b + wc * c, ray.direction), wb, wc};
}

}  // namespace ballflow::show
