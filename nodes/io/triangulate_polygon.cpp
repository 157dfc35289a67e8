#include "io/triangulate_polygon.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

struct FaceInfo {
  int winding = 0;
  bool seen = false;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Plane =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// Twice the vector area.
Vec3 normal_of(std::span<const Vec3> vertices, std::span<const std::int32_t> corners) {
  const auto at = [&](std::size_t i) { return vertices[static_cast<std::size_t>(corners[i])]; };
  Vec3 sum;
  for (std::size_t i = 2; i < corners.size(); ++i) sum = sum + cross(at(i - 1) - at(0), at(i) - at(0));
  return sum;
}

/// The axes from the one nearest to the normal on.
std::array<int, 3> axes_of(Vec3 normal) {
  const std::array<double, 3> size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  std::array<int, 3> axes{2, 0, 1};
  // Not a number, after an overflow, counts as nothing.
  const auto key = [&size](int axis) {
    const double s = size[static_cast<std::size_t>(axis)];
    return s > 0 ? s : 0;
  };
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return key(a) > key(b); });
  return axes;
}

/// The corners of a polygon, seen along a coordinate axis.
class View {
 public:
  View(std::span<const Vec3> vertices, std::span<const std::int32_t> corners, int axis)
      : vertices_(vertices), corners_(corners), axis_(axis) {}

  std::size_t size() const { return corners_.size(); }
  std::int32_t id(std::size_t corner) const { return corners_[corner]; }
  Point at(std::size_t corner) const {
    const Vec3& p = vertices_[static_cast<std::size_t>(corners_[corner])];
    return axis_ == 0 ? Point(p.y, p.z) : axis_ == 1 ? Point(p.z, p.x) : Point(p.x, p.y);
  }
  std::size_t next(std::size_t corner) const { return corner + 1 < size() ? corner + 1 : 0; }

  /// All triangles around the first corner turn the same way.
  bool is_fan() const {
    const Point apex = at(0);
    const CGAL::Orientation first = CGAL::orientation(apex, at(1), at(2));
    if (first == CGAL::COLLINEAR) return false;
    for (std::size_t i = 3; i < size(); ++i) {
      if (CGAL::orientation(apex, at(i - 1), at(i)) != first) return false;
    }
    return true;
  }

  bool is_convex() const {
    bool left = false, right = false;
    for (std::size_t i = 0; i < size(); ++i) {
      const CGAL::Orientation turn = CGAL::orientation(at(i), at(next(i)), at(next(next(i))));
      left = left || turn == CGAL::LEFT_TURN;
      right = right || turn == CGAL::RIGHT_TURN;
    }
    return !(left && right);
  }

 private:
  std::span<const Vec3> vertices_;
  std::span<const std::int32_t> corners_;
  int axis_;
};

/// How often the polygon runs from u to v more than from v to u.
class SideCounts {
 public:
  explicit SideCounts(const View& view) {
    for (std::size_t i = 0; i < view.size(); ++i) add(view.id(i), view.id(view.next(i)));
  }
  int operator()(std::int32_t u, std::int32_t v) const {
    const auto found = counts_.find(std::minmax(u, v));
    return found == counts_.end() ? 0 : u < v ? found->second : -found->second;
  }

 private:
  void add(std::int32_t u, std::int32_t v) { counts_[std::minmax(u, v)] += u < v ? 1 : -1; }
  std::map<std::pair<std::int32_t, std::int32_t>, int> counts_;
};

/// The triangulation of the plane with the sides of the polygon; none when two corners look alike, or sides
/// cross or touch each other between their ends.
std::optional<Plane> plane_with_sides(const View& view, Lookout& look) {
  std::optional<Plane> plane(std::in_place);
  std::vector<Plane::Vertex_handle> vertices(view.size());
  Plane::Face_handle near;
  for (std::size_t i = 0; i < view.size(); ++i) {
    look(256);
    const std::size_t before = plane->number_of_vertices();
    const auto vertex = plane->insert(view.at(i), near);
    if (plane->number_of_vertices() > before) vertex->info() = view.id(i);
    if (vertex->info() != view.id(i)) return std::nullopt;
    vertices[i] = vertex;
    near = vertex->face();
  }
  if (plane->dimension() < 2) return std::nullopt;
  try {
    for (std::size_t i = 0; i < view.size(); ++i) {
      look(256);
      const auto u = vertices[i], v = vertices[view.next(i)];
      Plane::Face_handle face;
      int side = 0;
      if (plane->is_edge(u, v, face, side) && plane->is_constrained({face, side})) continue;
      plane->insert_constraint(u, v);
      if (!plane->is_edge(u, v)) return std::nullopt;  // through a corner between them
    }
  } catch (const Plane::Intersection_of_constraints_exception&) {
    return std::nullopt;
  }
  return plane;
}

/// The triangles around which the polygon winds once, when it winds around all others not at all.
std::optional<std::vector<Triangle>> inside(const View& view, Lookout& look) {
  std::optional<Plane> plane = plane_with_sides(view, look);
  if (!plane) return std::nullopt;
  const SideCounts side_counts(view);
  const auto outside = plane->infinite_vertex();
  std::vector<Plane::Face_handle> reached = {plane->infinite_face()};
  reached[0]->info().seen = true;
  std::vector<Triangle> triangles;
  int direction = 0;  // in which the polygon winds
  while (!reached.empty()) {
    look(64);
    const auto face = reached.back();
    reached.pop_back();
    const int winding = face->info().winding;
    if (winding != 0) {
      if (direction == 0) direction = winding;
      if (winding != direction || std::abs(winding) != 1) return std::nullopt;
      const Triangle t{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
      triangles.push_back(winding > 0 ? t : Triangle{t[0], t[2], t[1]});
    }
    for (int i = 0; i < 3; ++i) {
      const auto neighbour = face->neighbor(i);
      if (neighbour->info().seen) continue;
      neighbour->info().seen = true;
      // The face is to the left of its side from u to v; to the left of the polygon the number is larger
      // by 1.
      const auto u = face->vertex(Plane::ccw(i)), v = face->vertex(Plane::cw(i));
      const int step = u == outside || v == outside ? 0 : side_counts(u->info(), v->info());
      neighbour->info().winding = winding - step;
      reached.push_back(neighbour);
    }
  }
  if (triangles.empty()) return std::nullopt;
  // In an order of their own, not that of a data structure.
  for (Triangle& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

bool is_flat(std::span<const Vec3> vertices, std::span<const std::int32_t> corners, Vec3 normal) {
  const double size = length(normal);
  if (!(size > 0)) return false;
  Box box;
  Vec3 sum;
  for (const std::int32_t c : corners) {
    box.add(vertices[static_cast<std::size_t>(c)]);
    sum = sum + vertices[static_cast<std::size_t>(c)];
  }
  const Vec3 mean = (1 / static_cast<double>(corners.size())) * sum;
  return std::all_of(corners.begin(), corners.end(), [&](std::int32_t c) {
    const double off = std::abs(dot(vertices[static_cast<std::size_t>(c)] - mean, normal)) / size;
    return off <= 0x1p-10 * box.longest_edge();
  });
}

}  // namespace

PolygonTriangulation triangulate_polygon(std::span<const Vec3> vertices,
                                         std::span<const std::int32_t> corners, std::vector<Triangle>& out,
                                         Monitor& monitor) {
  const auto fan = [&] {
    for (std::size_t i = 2; i < corners.size(); ++i) out.push_back({corners[0], corners[i - 1], corners[i]});
  };
  PolygonTriangulation result;
  if (corners.size() == 3) {
    fan();
    return result;
  }
  const Vec3 normal = normal_of(vertices, corners);
  std::optional<Lookout> look;
  for (const int axis : axes_of(normal)) {
    const View view(vertices, corners, axis);
    if (view.is_fan()) {
      fan();
      return result;
    }
    if (!look) look.emplace(monitor);
    if (const auto triangles = inside(view, *look)) {
      out.insert(out.end(), triangles->begin(), triangles->end());
      result.shape = view.is_convex() ? PolygonShape::filled : PolygonShape::concave;
      result.flat = is_flat(vertices, corners, normal);
      return result;
    }
  }
  fan();
  result.shape = PolygonShape::crossing;
  return result;
}

}  // namespace ballflow::geometry
