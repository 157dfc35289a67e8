// Points with rational coordinates, for oracles.
#pragma once

#include <CGAL/Exact_rational.h>

#include <array>

namespace ballflow::geometry::test {

using Q = CGAL::Exact_rational;
using Point = std::array<Q, 3>;

inline Q dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline bool is_zero(const Point& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

}  // namespace ballflow::geometry::test
