#include "sample/affine_span.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace ballflow::geometry {

int affine_dimension(std::span<const Vec3> points) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  const auto exact = [](const Vec3& p) { return Point(p.x, p.y, p.z); };
  auto p = points.begin();
  if (p == points.end()) return -1;
  const Point a = exact(*p);
  while (p != points.end() && exact(*p) == a) ++p;
  if (p == points.end()) return 0;
  const Point b = exact(*p);
  while (p != points.end() && CGAL::collinear(a, b, exact(*p))) ++p;
  if (p == points.end()) return 1;
  const Point c = exact(*p);
  while (p != points.end() && CGAL::coplanar(a, b, c, exact(*p))) ++p;
  return p == points.end() ? 2 : 3;
}

}  // namespace ballflow::geometry
