#include "exact/separation.hpp"

#include <CGAL/Gmpzf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "exact/double_double.hpp"
#include "exact/long_number.hpp"

namespace ballflow::geometry {
namespace {

using Ring = CGAL::Gmpzf;  // sums and products of doubles, exactly

DoubleDouble difference(double a, double b) { return DoubleDouble::sum(a, -b); }

DoubleDouble magnitude(DoubleDouble a) {
  return a.high < 0 || (a.high == 0 && a.low < 0) ? DoubleDouble{-a.high, -a.low} : a;
}
bool equal(DoubleDouble a, DoubleDouble b) { return a.high == b.high && a.low == b.low; }
bool less(DoubleDouble a, DoubleDouble b) { return a.high != b.high ? a.high < b.high : a.low < b.low; }

// |x|, |y|, |z| of the difference of the centers in ascending order, and the sum of the radii: all exactly,
// for a sum of two doubles is a pair of doubles in one way only.
struct Shape {
  std::array<DoubleDouble, 3> edges;
  DoubleDouble radii;
};
Shape shape_of(const BallPair& p) {
  Shape s{{magnitude(difference(p.a.x, p.b.x)), magnitude(difference(p.a.y, p.b.y)),
           magnitude(difference(p.a.z, p.b.z))},
          DoubleDouble::sum(p.radius_a, p.radius_b)};
  std::sort(s.edges.begin(), s.edges.end(), less);
  return s;
}
bool equal(const Shape& p, const Shape& q) {
  return equal(p.radii, q.radii) && equal(p.edges[0], q.edges[0]) && equal(p.edges[1], q.edges[1]) &&
         equal(p.edges[2], q.edges[2]);
}

// The separation in twice the bits of a double; `sure` where its error is below 2^-94 (distance + radii).
//
// Edges are exact, their squares and sums lose 4 parts in 2^103, the root half of that and what one step of
// Newton's method leaves: it begins with 52 right bits, and ends with more than 100.
struct Long {
  DoubleDouble value;
  double size;
  bool sure;
};
Long long_separation(const Shape& s) {
  DoubleDouble squared{0, 0};
  for (const DoubleDouble edge : s.edges) squared = squared + edge * edge;
  DoubleDouble root{0, 0};
  if (squared.high > 0) {
    const DoubleDouble first{std::sqrt(squared.high)};
    const DoubleDouble rest = squared - first * first;
    root = DoubleDouble::sum(first.high, (rest / (first + first)).high);
  }
  const bool plain = (s.edges[2].high == 0 && s.edges[2].low == 0) || squared.high > 1e-250;
  return {root - s.radii, root.high + s.radii.high, plain};
}

Ring squared_distance_of(const BallPair& p) {
  Ring sum(0);
  for (const auto& [u, v] : {std::pair{p.a.x, p.b.x}, std::pair{p.a.y, p.b.y}, std::pair{p.a.z, p.b.z}}) {
    const Ring edge = Ring(u) - Ring(v);
    sum = sum + edge * edge;
  }
  return sum;
}
Ring radii_of(const BallPair& p) { return Ring(p.radius_a) + Ring(p.radius_b); }

int sign_of(const Ring& a) { return static_cast<int>(CGAL::sign(a)); }

// The sign of sqrt(p) - sqrt(q) - u: of both sides of sqrt(p) - sqrt(q) = u the signs are known, and where
// they are equal, their squares decide: p + q - u^2 against 2 sqrt(p q).
int sign_of_roots(const Ring& p, const Ring& q, const Ring& u) {
  const int left = sign_of(p - q), right = sign_of(u);
  if (left != right) return left > right ? 1 : -1;
  if (left == 0) return 0;
  const Ring rest = p + q - u * u;
  const int squares = sign_of(rest) < 0 ? -1 : sign_of(rest * rest - Ring(4) * (p * q));
  return left * squares;
}

// In so many bits that eleven more than a double has are right, however much cancels; the separation is not
// 0.
LongNumber many_bits(const BallPair& p, long bits = 256) {
  const auto number = [bits](double x) { return LongNumber(x, bits); };
  const LongNumber x = number(p.a.x) - number(p.b.x), y = number(p.a.y) - number(p.b.y),
                   z = number(p.a.z) - number(p.b.z);
  const LongNumber value = square_root(x * x + y * y + z * z) - number(p.radius_a) - number(p.radius_b);
  // Below 2^-1100 every value rounds to 0.
  return value.known_to(64, -1100) ? value : many_bits(p, 2 * bits);
}

}  // namespace

int compare_separations(const BallPair& p, const BallPair& q) {
  const RoughSeparation rough_p = rough_separation(p), rough_q = rough_separation(q);
  const double gap = rough_p.value - rough_q.value;
  // Four times the errors: their sum and the difference are rounded, too.
  if (std::abs(gap) > 2 * (rough_p.error + rough_q.error)) return gap > 0 ? 1 : -1;
  const Shape shape_p = shape_of(p), shape_q = shape_of(q);
  if (equal(shape_p, shape_q)) return 0;
  const Long long_p = long_separation(shape_p), long_q = long_separation(shape_q);
  if (long_p.sure && long_q.sure) {
    const DoubleDouble more = long_p.value - long_q.value;
    if (std::abs(more.high) > 0x1p-90 * (long_p.size + long_q.size) + 1e-260) return more.high > 0 ? 1 : -1;
  }
  return sign_of_roots(squared_distance_of(p), squared_distance_of(q), radii_of(p) - radii_of(q));
}

int compare_separation(const BallPair& p, double value) {
  const RoughSeparation rough = rough_separation(p);
  const double gap = rough.value - value;
  if (std::abs(gap) > 2 * rough.error + 0x1p-50 * std::abs(value)) return gap > 0 ? 1 : -1;
  const Ring reach = radii_of(p) + Ring(value);
  if (sign_of(reach) < 0) return 1;
  return sign_of(squared_distance_of(p) - reach * reach);
}

double nearest_separation(const BallPair& p) {
  const Long rough = long_separation(shape_of(p));
  // Both ends of what it may be round to the same double.
  const double error = 0x1p-90 * rough.size + 1e-260;
  const double below = rough.value.high + (rough.value.low - error);
  if (rough.sure && below == rough.value.high + (rough.value.low + error)) return below;
  const int sign = compare_separation(p, 0);
  if (sign == 0) return 0;
  const double value = many_bits(p).nearest();
  const double least = std::numeric_limits<double>::denorm_min();
  return sign > 0 ? std::max(value, least) : std::min(value, -least);
}

double separation_at_least(const BallPair& p) {
  double value = nearest_separation(p);
  while (compare_separation(p, value) < 0) value = std::nextafter(value, -INFINITY);
  return value;
}

double separation_at_most(const BallPair& p) {
  double value = nearest_separation(p);
  while (compare_separation(p, value) > 0) value = std::nextafter(value, INFINITY);
  return value;
}

}  // namespace ballflow::geometry
