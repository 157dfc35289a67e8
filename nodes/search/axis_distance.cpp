#include "search/axis_distance.hpp"

#include <algorithm>
#include <limits>

#include "base/for_each_block.hpp"

namespace ballflow::geometry {
namespace {

Box box_of(const std::array<Vec3, 3>& corners) { return bounding_box(corners); }

double area_of(Vec3 a, Vec3 b, Vec3 c) { return length(cross(b - a, c - a)); }

/// In the box of the corners, where the point is without rounding.
Vec3 clamped(Vec3 q, const Box& box) {
  return {std::clamp(q.x, box.lower.x, box.upper.x), std::clamp(q.y, box.lower.y, box.upper.y),
          std::clamp(q.z, box.lower.z, box.upper.z)};
}

Vec3 on_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double squared = squared_length(ab);
  return a + (squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0) * ab;
}

double distance_to(Vec3 p, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Box box = box_of(corners);
  const auto to = [&](Vec3 q) { return distance(p, clamped(q, box)); };
  double least = to(on_segment(p, a, b));
  if (c == b) return least;
  least = std::min({least, to(on_segment(p, b, c)), to(on_segment(p, c, a))});
  // The foot on the plane, by weights of the corners; whatever rounding makes of them, the point is taken
  // from the triangle.
  const Vec3 u = b - a, v = c - a, w = p - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return least;
  const double s = (wu * vv - wv * uv) / determinant, t = (wv * uu - wu * uv) / determinant;
  if (!(s > 0 && t > 0 && s + t < 1)) return least;
  return std::min(least, to(a + s * u + t * v));
}

}  // namespace

AxisDistance::AxisDistance(std::span<const MedialAxis> axes, Monitor& monitor) {
  for (const MedialAxis& axis : axes) add(axis);
  if (simplices_.empty()) {
    throw InputError(
        "the medial axes have no vertex",
        "connect the axes of the unions of inner and of outer polar balls, one of which has balls");
  }
  std::vector<Box> boxes(simplices_.size());
  std::transform(simplices_.begin(), simplices_.end(), boxes.begin(), box_of);
  tree_ = BoxTree(boxes, BoxTree::default_leaf_size, monitor);
}

void AxisDistance::add(const MedialAxis& axis) {
  const auto vertex = [&](std::int32_t v) { return axis.vertices[static_cast<std::size_t>(v)]; };
  std::vector<std::uint8_t> used(axis.vertices.size(), 0);
  for (const std::int32_t v : axis.polygon_vertices) used[static_cast<std::size_t>(v)] = 1;
  for (const auto& [a, b] : axis.edges) {
    used[static_cast<std::size_t>(a)] = used[static_cast<std::size_t>(b)] = 1;
    simplices_.push_back({vertex(a), vertex(b), vertex(b)});
  }
  for (std::size_t v = 0; v < axis.vertices.size(); ++v) {
    if (used[v] == 0) simplices_.push_back({axis.vertices[v], axis.vertices[v], axis.vertices[v]});
  }
  for (std::size_t i = 0; i < axis.polygons(); ++i) add_polygon(axis, axis.polygon(i));
}

/// A fan from a corner that sees all of the polygon: of all fans it has the least area.
void AxisDistance::add_polygon(const MedialAxis& axis, std::span<const std::int32_t> corners) {
  const std::size_t n = corners.size();
  const auto corner = [&](std::size_t k) { return axis.vertices[static_cast<std::size_t>(corners[k % n])]; };
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t from = 0; from < n && n > 3; ++from) {
    double area = 0;
    for (std::size_t k = from + 1; k + 1 < from + n; ++k)
      area += area_of(corner(from), corner(k), corner(k + 1));
    if (area < least * (1 - 1e-9)) {
      best = from;
      least = area;
    }
  }
  for (std::size_t k = best + 1; k + 1 < best + n; ++k) {
    simplices_.push_back({corner(best), corner(k), corner(k + 1)});
  }
}

double AxisDistance::operator()(Vec3 p) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return tree_.smallest(p, infinity, -infinity, [&](std::size_t i) { return distance_to(p, simplices_[i]); });
}

std::vector<double> axis_distances(std::span<const Vec3> points, const AxisDistance& axis, Monitor& monitor) {
  std::vector<double> result(points.size());
  for_each_block(points.size(), 256, monitor, 0, 1, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) result[i] = axis(points[i]);
  });
  return result;
}

}  // namespace ballflow::geometry
