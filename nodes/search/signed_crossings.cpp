#include "search/signed_crossings.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "search/box_tree.hpp"

namespace ballflow::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr std::size_t leaf_size = 4;

float rounded_down(double value) {
  const auto near = static_cast<float>(value);
  return near > value ? std::nextafter(near, -std::numeric_limits<float>::infinity()) : near;
}
float rounded_up(double value) {
  const auto near = static_cast<float>(value);
  return near < value ? std::nextafter(near, std::numeric_limits<float>::infinity()) : near;
}

// Sign of the area of u, v and the point moved by (e, e^2); never 0 unless u and v have equal x and y.
// Swapping u and v swaps the sign.
int side_of_edge(Vec3 u, Vec3 v, Vec3 point) {
  const double left = (v.x - u.x) * (point.y - u.y), right = (v.y - u.y) * (point.x - u.x);
  const double determinant = left - right, size = std::abs(left) + std::abs(right);
  // Rounding errors are below 3.4e-16 times the size unless something underflows.
  if (size > 1e-280 && std::abs(determinant) > 3.4e-16 * size) return determinant > 0 ? 1 : -1;
  const CGAL::Orientation exact = CGAL::orientation(Kernel::Point_2(u.x, u.y), Kernel::Point_2(v.x, v.y),
                                                    Kernel::Point_2(point.x, point.y));
  if (exact != CGAL::COLLINEAR) return exact == CGAL::LEFT_TURN ? 1 : -1;
  if (u.y != v.y) return u.y > v.y ? 1 : -1;
  if (u.x != v.x) return v.x > u.x ? 1 : -1;
  return 0;
}

}  // namespace

SignedCrossings::SignedCrossings(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                 Monitor& monitor) {
  if (triangles.empty()) return;
  const BoxTree tree(boxes_of(vertices, triangles), leaf_size, monitor);
  nodes_.reserve(tree.nodes().size());
  for (const auto& [box, first, last, second] : tree.nodes()) {
    const bool leaf = second == 0;
    nodes_.push_back({rounded_down(box.lower.x), rounded_up(box.upper.x), rounded_down(box.lower.y),
                      rounded_up(box.upper.y), rounded_up(box.upper.z), leaf ? first : second,
                      leaf ? last - first : 0});
  }
  ids_ = tree.order();
  corners_.reserve(ids_.size());
  for (const std::int32_t id : ids_) {
    const Triangle& t = triangles[static_cast<std::size_t>(id)];
    corners_.push_back({vertices[static_cast<std::size_t>(t[0])], vertices[static_cast<std::size_t>(t[1])],
                        vertices[static_cast<std::size_t>(t[2])]});
  }
}

int SignedCrossings::crossing(const Corners& triangle, Vec3 point, bool& on) {
  const auto& [a, b, c] = triangle;
  if (point.z > std::max({a.z, b.z, c.z})) return 0;
  if (point.x < std::min({a.x, b.x, c.x}) || point.x > std::max({a.x, b.x, c.x})) return 0;
  if (point.y < std::min({a.y, b.y, c.y}) || point.y > std::max({a.y, b.y, c.y})) return 0;
  const int sign = side_of_edge(a, b, point);
  // Triangles that project to a segment have sides of different signs: they are never crossed.
  if (sign == 0 || side_of_edge(b, c, point) != sign || side_of_edge(c, a, point) != sign) return 0;
  if (point.z < std::min({a.z, b.z, c.z})) return sign;
  const auto exact = [](Vec3 p) { return Kernel::Point_3(p.x, p.y, p.z); };
  const CGAL::Orientation side = CGAL::orientation(exact(a), exact(b), exact(c), exact(point));
  on = side == CGAL::COPLANAR;
  const bool above = side == (sign > 0 ? CGAL::NEGATIVE : CGAL::POSITIVE);
  return on || above ? sign : 0;
}

}  // namespace ballflow::geometry
