#include "search/self_intersection.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <vector>

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Pair = std::array<std::int32_t, 2>;

class Triangles {
 public:
  explicit Triangles(const TriangleMesh& mesh) : mesh_(mesh) {}

  bool flat(std::int32_t t) const {
    const Triangle& f = corners(t);
    return CGAL::collinear(point(f[0]), point(f[1]), point(f[2]));
  }

  CGAL::Bbox_3 box(std::int32_t t) const {
    const Triangle& f = corners(t);
    return point(f[0]).bbox() + point(f[1]).bbox() + point(f[2]).bbox();
  }

  /// Both triangles have an area.
  bool intersect(std::int32_t s, std::int32_t t) const {
    // Corners of both come first, in the same order.
    Triangle a = corners(s), b = corners(t);
    std::size_t common = 0;
    for (std::size_t i = common; i < 3; ++i) {
      const auto same = std::find(b.begin() + static_cast<std::ptrdiff_t>(common), b.end(), a[i]);
      if (same == b.end()) continue;
      std::swap(*same, b[common]);
      std::swap(a[i], a[common]);
      ++common;
    }
    const Point p[] = {point(a[0]), point(a[1]), point(a[2])};
    const Point q[] = {point(b[0]), point(b[1]), point(b[2])};
    switch (common) {
      case 0:
        return CGAL::do_intersect(Kernel::Triangle_3(p[0], p[1], p[2]), Kernel::Triangle_3(q[0], q[1], q[2]));
      case 1:  // further points in common lie on a side opposite the vertex as well
        return CGAL::do_intersect(Kernel::Segment_3(p[1], p[2]), Kernel::Triangle_3(q[0], q[1], q[2])) ||
               CGAL::do_intersect(Kernel::Segment_3(q[1], q[2]), Kernel::Triangle_3(p[0], p[1], p[2]));
      case 2:  // one is folded onto the other
        return CGAL::coplanar(p[0], p[1], p[2], q[2]) &&
               CGAL::coplanar_orientation(p[0], p[1], p[2], q[2]) == CGAL::POSITIVE;
      default:
        return true;
    }
  }

 private:
  const Triangle& corners(std::int32_t t) const { return mesh_.triangles[static_cast<std::size_t>(t)]; }
  Point point(std::int32_t v) const {
    const Vec3 p = mesh_.vertices[static_cast<std::size_t>(v)];
    return {p.x, p.y, p.z};
  }
  const TriangleMesh& mesh_;
};

/// Calls visit(s, t) for pairs of triangles with a point in common which is not their common vertex or edge,
/// and flat(t) for triangles without area, which are in no pair. Ends early where one of them returns false.
template <class Flat, class Visit>
void for_each_intersection(const TriangleMesh& mesh, Monitor& monitor, const Flat& flat, const Visit& visit) {
  using TriangleBox = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Triangle*>;
  struct Enough {};
  Lookout look(monitor);
  const Triangles triangles(mesh);
  std::vector<TriangleBox> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::int32_t t = 0; static_cast<std::size_t>(t) < mesh.triangles.size(); ++t) {
    look(64);
    if (!triangles.flat(t)) {
      boxes.emplace_back(triangles.box(t), mesh.triangles.data() + t);
    } else if (!flat(t)) {
      return;
    }
  }
  const auto index = [&](const TriangleBox& box) {
    return static_cast<std::int32_t>(box.handle() - mesh.triangles.data());
  };
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                  [&](const TriangleBox& a, const TriangleBox& b) {
                                    look(256);
                                    if (triangles.intersect(index(a), index(b)) && !visit(index(a), index(b)))
                                      throw Enough();
                                  });
  } catch (const Enough&) {
  }
}

}  // namespace

std::optional<Pair> self_intersection(const TriangleMesh& mesh, Monitor& monitor) {
  std::optional<Pair> found;
  for_each_intersection(
      mesh, monitor,
      [&](std::int32_t t) {
        found = Pair{t, t};
        return false;
      },
      [&](std::int32_t s, std::int32_t t) {
        found = Pair{s, t};
        return false;
      });
  return found;
}

SelfIntersections self_intersections(const TriangleMesh& mesh, std::size_t most, Monitor& monitor) {
  SelfIntersections found;
  for_each_intersection(
      mesh, monitor,
      [&](std::int32_t t) {
        found.flat.push_back(t);
        return true;
      },
      [&](std::int32_t s, std::int32_t t) {
        found.all = found.pairs.size() < most;
        if (found.all) found.pairs.push_back({std::min(s, t), std::max(s, t)});
        return found.all;
      });
  std::sort(found.pairs.begin(), found.pairs.end());
  return found;
}

}  // namespace ballflow::geometry
