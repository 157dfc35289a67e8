#include "exact/ball_predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

#include "exact/double_double.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <class Real>
struct Arithmetic;
template <>
struct Arithmetic<double> {
  static constexpr double unit = 0x1p-53;  // bound of the relative error of one operation
  static double of(double a) { return a; }
  static double difference(double a, double b) { return a - b; }
  static double near(double a) { return a; }
};
template <>
struct Arithmetic<DoubleDouble> {
  static constexpr double unit = 0x1p-103;
  static DoubleDouble of(double a) { return {a, 0}; }
  static DoubleDouble difference(double a, double b) { return DoubleDouble::sum(a, -b); }
  static double near(DoubleDouble a) { return a.high; }
};

// A number and a bound of its error: |value - exact value| <= 64 unit size + 1e-130.
//
// Sums and products are computed for values and, with absolute values, for sizes. By induction the error is
// at most ((1 + unit)^k - 1) size, where k = 1 for the difference of two coordinates, max + 1 for a sum and
// k + l + 1 for a product; the longest expression below has k = 36, and sizes are themselves too small by a
// factor of no less than (1 - 2^-53)^36. What underflows is wrong by less than 1e-300, times at most 1e170
// with the magnitudes that BallPredicates lets pass. What overflows is not finite, and so never sure.
template <class Real>
struct Rounded {
  Real value{};
  double size = 0;

  friend Rounded operator+(Rounded a, Rounded b) { return {a.value + b.value, a.size + b.size}; }
  friend Rounded operator-(Rounded a, Rounded b) { return {a.value - b.value, a.size + b.size}; }
  friend Rounded operator*(Rounded a, Rounded b) { return {a.value * b.value, a.size * b.size}; }
};
template <class Real>
Rounded<Real> exactly(double value) {
  return {Arithmetic<Real>::of(value), std::abs(value)};
}
template <class Real>
Rounded<Real> difference(double a, double b) {
  return {Arithmetic<Real>::difference(a, b), std::abs(a - b)};
}

enum class Sign { negative, positive, unsure };
template <class Real>
Sign sign_of(const Rounded<Real>& a) {
  const double value = Arithmetic<Real>::near(a.value);
  const double error = 64 * Arithmetic<Real>::unit * a.size + 1e-100;
  return value > error ? Sign::positive : value < -error ? Sign::negative : Sign::unsure;
}

// The sign of an expression that is written for any kind of number: with doubles, then with twice as many
// bits.
template <class Expression>
Sign sign_of_rounded(const Expression& expression) {
  const Sign sign = sign_of(expression(double{}));
  return sign != Sign::unsure ? sign : sign_of(expression(DoubleDouble{}));
}

template <class Real>
struct Vector {
  Rounded<Real> x, y, z;
  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator*(Rounded<Real> s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
};
template <class Real>
Rounded<Real> scalar(const Vector<Real>& a, const Vector<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
Vector<Real> product(const Vector<Real>& a, const Vector<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// A ball seen from the first one of its simplex: its centre, and the power of the first centre to it plus the
// weight of the first. In these coordinates the orthogonal sphere has 2 c . at = lift for every ball of the
// simplex and R^2 = |c|^2 - w_0, and a ball attaches the simplex when lift < 2 c . at.
template <class Real>
struct Relative {
  template <class Ball>
  Relative(const Ball& first, const Ball& ball)
      : at{difference<Real>(ball.center.x, first.center.x), difference<Real>(ball.center.y, first.center.y),
           difference<Real>(ball.center.z, first.center.z)},
        lift(scalar(at, at) - exactly<Real>(ball.weight) + exactly<Real>(first.weight)) {}
  Vector<Real> at;
  Rounded<Real> lift;
};

template <class Ball>
Kernel::Weighted_point_3 exact(const Ball& b) {
  return {Kernel::Point_3(b.center.x, b.center.y, b.center.z), b.weight};
}

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
    const Sign sign = sign_of_rounded([&](auto number) {
      using Real = decltype(number);
      const Relative<Real> a(p, q), b(p, r), c(p, s);
      const Vector<Real> bc = product(b.at, c.at);
      const Rounded<Real> det = scalar(a.at, bc);
      const Vector<Real> n = a.lift * bc + b.lift * product(c.at, a.at) + c.lift * product(a.at, b.at);
      return scalar(n, n) - exactly<Real>(4) * (det * det) * exactly<Real>(p.weight);
    });
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().compare_weighted_squared_radius_3_object()(exact(p), exact(q), exact(r), exact(s), 0.0) !=
         CGAL::LARGER;
}

// c = (lift_1 a2 x n + lift_2 n x a1) / (2 n . n), n = a1 x a2
bool BallPredicates::meets(const std::array<std::int32_t, 3>& balls) const {
  const Ball &p = ball(balls[0]), &q = ball(balls[1]), &r = ball(balls[2]);
  if (ordinary_) {
    const Sign sign = sign_of_rounded([&](auto number) {
      using Real = decltype(number);
      const Relative<Real> a(p, q), b(p, r);
      const Vector<Real> n = product(a.at, b.at);
      const Vector<Real> m = a.lift * product(b.at, n) + b.lift * product(n, a.at);
      const Rounded<Real> nn = scalar(n, n);
      return scalar(m, m) - exactly<Real>(4) * (nn * nn) * exactly<Real>(p.weight);
    });
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().compare_weighted_squared_radius_3_object()(exact(p), exact(q), exact(r), 0.0) !=
         CGAL::LARGER;
}

// c = lift_1 / (2 a1 . a1) a1
bool BallPredicates::meets(const std::array<std::int32_t, 2>& balls) const {
  const Ball &p = ball(balls[0]), &q = ball(balls[1]);
  if (ordinary_) {
    const Sign sign = sign_of_rounded([&](auto number) {
      using Real = decltype(number);
      const Relative<Real> a(p, q);
      return a.lift * a.lift - exactly<Real>(4) * scalar(a.at, a.at) * exactly<Real>(p.weight);
    });
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().compare_weighted_squared_radius_3_object()(exact(p), exact(q), 0.0) != CGAL::LARGER;
}

bool BallPredicates::attaches(const std::array<std::int32_t, 3>& balls, std::int32_t other) const {
  const Ball &p = ball(balls[0]), &q = ball(balls[1]), &r = ball(balls[2]), &t = ball(other);
  if (ordinary_) {
    const Sign sign = sign_of_rounded([&](auto number) {
      using Real = decltype(number);
      const Relative<Real> a(p, q), b(p, r), o(p, t);
      const Vector<Real> n = product(a.at, b.at);
      const Vector<Real> m = a.lift * product(b.at, n) + b.lift * product(n, a.at);
      return o.lift * scalar(n, n) - scalar(m, o.at);
    });
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().power_side_of_bounded_power_sphere_3_object()(exact(p), exact(q), exact(r), exact(t)) ==
         CGAL::ON_BOUNDED_SIDE;
}

bool BallPredicates::attaches(const std::array<std::int32_t, 2>& balls, std::int32_t other) const {
  const Ball &p = ball(balls[0]), &q = ball(balls[1]), &t = ball(other);
  if (ordinary_) {
    const Sign sign = sign_of_rounded([&](auto number) {
      using Real = decltype(number);
      const Relative<Real> a(p, q), o(p, t);
      return o.lift * scalar(a.at, a.at) - a.lift * scalar(a.at, o.at);
    });
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().power_side_of_bounded_power_sphere_3_object()(exact(p), exact(q), exact(t)) ==
         CGAL::ON_BOUNDED_SIDE;
}

bool BallPredicates::attaches(std::int32_t own, std::int32_t other) const {
  const Ball &p = ball(own), &t = ball(other);
  if (ordinary_) {
    const Sign sign = sign_of_rounded([&](auto number) {
      using Real = decltype(number);
      return Relative<Real>(p, t).lift;
    });
    if (sign != Sign::unsure) return sign == Sign::negative;
  }
  return Kernel().power_side_of_bounded_power_sphere_3_object()(exact(p), exact(t)) == CGAL::ON_BOUNDED_SIDE;
}

// The sign of the determinant of the lifted points, t in the origin. Depth of the expression: 19.
int quick_power_side(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                     const WeightedPoint& s, const WeightedPoint& t) {
  const Sign sign = sign_of_rounded([&](auto number) {
    using Real = decltype(number);
    const Relative<Real> a(t, p), b(t, q), c(t, r), d(t, s);
    const auto minor = [](const Relative<Real>& u, const Relative<Real>& v) {
      return u.at.x * v.at.y - u.at.y * v.at.x;
    };
    const auto other = [](const Relative<Real>& u, const Relative<Real>& v) {
      return u.at.z * v.lift - u.lift * v.at.z;
    };
    return (minor(a, b) * other(c, d) + minor(c, d) * other(a, b)) +
           (minor(a, d) * other(b, c) + minor(b, c) * other(a, d)) -
           (minor(a, c) * other(b, d) + minor(b, d) * other(a, c));
  });
  return sign == Sign::unsure ? 0 : sign == Sign::negative ? 1 : -1;
}

}  // namespace ballflow::geometry
