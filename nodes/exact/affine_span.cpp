#include "exact/affine_span.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <string>

#include "base/monitor.hpp"

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

void require_space_filling(std::span<const Vec3> points) {
  const int dimension = affine_dimension(points);
  if (dimension == 3) return;
  const std::string number = std::to_string(points.size());
  static constexpr std::array places = {"nowhere", "in one place", "on one line", "in one plane"};
  throw InputError(
      points.size() < 4
          ? "the sample has only " + number + (points.size() == 1 ? " point" : " distinct points")
          : "all " + number + " points lie " + places[static_cast<std::size_t>(dimension + 1)],
      "a sample of a surface in space has at least four points that are not in one plane");
}

}  // namespace ballflow::geometry
