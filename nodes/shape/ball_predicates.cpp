#include "shape/ball_predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// A double and a bound of its error: |value - exact value| <= 2^-47 size + 1e-130.
//
// Sums and products are computed for values and, with absolute values, for sizes. By induction the error is
// at most ((1 + u)^k - 1) size, u = 2^-53, where k = 1 for the difference of two coordinates, max + 1 for a
// sum and k + l + 1 for a product; the longest expression below has k = 36, and sizes are themselves too
// small by no more than that. What underflows is wrong by less than 1e-320, times at most 1e190 with the
// magnitudes that BallPredicates lets pass. What overflows is not finite, and so never sure.
struct Rounded {
  double value = 0, size = 0;

  friend Rounded operator+(Rounded a, Rounded b) { return {a.value + b.value, a.size + b.size}; }
  friend Rounded operator-(Rounded a, Rounded b) { return {a.value - b.value, a.size + b.size}; }
  friend Rounded operator*(Rounded a, Rounded b) { return {a.value * b.value, a.size * b.size}; }
};
Rounded exactly(double value) { return {value, std::abs(value)}; }
Rounded difference(double a, double b) { return exactly(a - b); }

enum class Sign { negative, positive, unsure };
Sign sign_of(Rounded a) {
  const double error = 0x1p-47 * a.size + 1e-100;
  return a.value > error ? Sign::positive : a.value < -error ? Sign::negative : Sign::unsure;
}

struct Vector {
  Rounded x, y, z;
  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator*(Rounded s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
};
Vector difference(Vec3 a, Vec3 b) {
  return {difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)};
}
Rounded scalar(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector product(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// A ball seen from the first one of its simplex: its centre, and the power of the first centre to it plus the
// weight of the first. In these coordinates the orthogonal sphere has 2 c . at = lift for every ball of the
// simplex and R^2 = |c|^2 - w_0, and a ball attaches the simplex when lift < 2 c . at.
template <class Ball>
struct Relative {
  Relative(const Ball& first, const Ball& ball)
      : at(difference(ball.center, first.center)),
        lift(scalar(at, at) - exactly(ball.weight) + exactly(first.weight)) {}
  Vector at;
  Rounded lift;
};

template <class Ball>
Kernel::Weighted_point_3 exact(const Ball& b) {
  return {Kernel::Point_3(b.center.x, b.center.y, b.center.z), b.weight};
}

constexpr Rounded four{4, 4};

}  // namespace

BallPredicates::BallPredicates(std::span<const Vec3> centers, std::span<const double> weights) {
  balls_.reserve(centers.size());
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const Vec3 c = centers[i];
    balls_.push_back({c, weights[i]});
    ordinary_ = ordinary_ && std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) <= 1e20 &&
                std::abs(weights[i]) <= 1e40;
  }
}

// c = (lift_1 a2 x a3 + lift_2 a3 x a1 + lift_3 a1 x a2) / (2 a1 . (a2 x a3))
bool BallPredicates::meets(const std::array<std::int32_t, 4>& balls) const {
  const Ball &p = ball(balls[0]), &q = ball(balls[1]), &r = ball(balls[2]), &s = ball(balls[3]);
  if (ordinary_) {
    const Relative a(p, q), b(p, r), c(p, s);
    const Vector bc = product(b.at, c.at);
    const Rounded det = scalar(a.at, bc);
    const Vector n = a.lift * bc + b.lift * product(c.at, a.at) + c.lift * product(a.at, b.at);
    const Sign sign = sign_of(scalar(n, n) - four * (det * det) * exactly(p.weight));
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().compare_weighted_squared_radius_3_object()(exact(p), exact(q), exact(r), exact(s), 0.0) !=
         CGAL::LARGER;
}

// c = (lift_1 a2 x n + lift_2 n x a1) / (2 n . n), n = a1 x a2
bool BallPredicates::meets(const std::array<std::int32_t, 3>& balls) const {
  const Ball &p = ball(balls[0]), &q = ball(balls[1]), &r = ball(balls[2]);
  if (ordinary_) {
    const Relative a(p, q), b(p, r);
    const Vector n = product(a.at, b.at);
    const Vector m = a.lift * product(b.at, n) + b.lift * product(n, a.at);
    const Rounded nn = scalar(n, n);
    const Sign sign = sign_of(scalar(m, m) - four * (nn * nn) * exactly(p.weight));
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().compare_weighted_squared_radius_3_object()(exact(p), exact(q), exact(r), 0.0) !=
         CGAL::LARGER;
}

// c = lift_1 / (2 a1 . a1) a1
bool BallPredicates::meets(const std::array<std::int32_t, 2>& balls) const {
  const Ball &p = ball(balls[0]), &q = ball(balls[1]);
  if (ordinary_) {
    const Relative a(p, q);
    const Sign sign = sign_of(a.lift * a.lift - four * scalar(a.at, a.at) * exactly(p.weight));
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().compare_weighted_squared_radius_3_object()(exact(p), exact(q), 0.0) != CGAL::LARGER;
}

bool BallPredicates::attaches(const std::array<std::int32_t, 3>& balls, std::int32_t other) const {
  const Ball &p = ball(balls[0]), &q = ball(balls[1]), &r = ball(balls[2]), &t = ball(other);
  if (ordinary_) {
    const Relative a(p, q), b(p, r), o(p, t);
    const Vector n = product(a.at, b.at);
    const Vector m = a.lift * product(b.at, n) + b.lift * product(n, a.at);
    const Sign sign = sign_of(o.lift * scalar(n, n) - scalar(m, o.at));
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().power_side_of_bounded_power_sphere_3_object()(exact(p), exact(q), exact(r), exact(t)) ==
         CGAL::ON_BOUNDED_SIDE;
}

bool BallPredicates::attaches(const std::array<std::int32_t, 2>& balls, std::int32_t other) const {
  const Ball &p = ball(balls[0]), &q = ball(balls[1]), &t = ball(other);
  if (ordinary_) {
    const Relative a(p, q), o(p, t);
    const Sign sign = sign_of(o.lift * scalar(a.at, a.at) - a.lift * scalar(a.at, o.at));
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().power_side_of_bounded_power_sphere_3_object()(exact(p), exact(q), exact(t)) ==
         CGAL::ON_BOUNDED_SIDE;
}

bool BallPredicates::attaches(std::int32_t own, std::int32_t other) const {
  const Ball &p = ball(own), &t = ball(other);
  if (ordinary_) {
    const Sign sign = sign_of(Relative(p, t).lift);
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().power_side_of_bounded_power_sphere_3_object()(exact(p), exact(t)) == CGAL::ON_BOUNDED_SIDE;
}

}  // namespace ballflow::geometry
