#include "search/surface_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ballflow::geometry {
namespace {

Vec3 nearest_on_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double squared = squared_length(ab);
  const double t = squared > 0 ? dot(p - a, ab) / squared : 0;
  if (!(t > 0)) return a;
  return t < 1 ? a + t * ab : b;
}

/// A triangle without area is its edges.
Vec3 nearest_on_triangle(Vec3 p, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vec3 normal = cross(b - a, c - a);
  const double squared = squared_length(normal);
  const auto left_of = [&](Vec3 from, Vec3 to) { return dot(cross(to - from, p - from), normal) >= 0; };
  if (squared > 0 && left_of(a, b) && left_of(b, c) && left_of(c, a)) {
    return p - (dot(p - a, normal) / squared) * normal;
  }
  Vec3 best = nearest_on_segment(p, a, b);
  for (const Vec3 q : {nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)}) {
    if (squared_distance(p, q) < squared_distance(p, best)) best = q;
  }
  return best;
}

/// Where a line meets a triangle, in lengths of its direction (Moeller and Trumbore 1997).
std::optional<double> meeting(Vec3 origin, Vec3 direction, const std::array<Vec3, 3>& corners) {
  const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const Vec3 p = cross(direction, v);
  const double det = dot(u, p);
  if (det == 0) return std::nullopt;
  const Vec3 to = origin - corners[0];
  const double a = dot(to, p) / det;
  if (!(a >= 0 && a <= 1)) return std::nullopt;
  const Vec3 q = cross(to, u);
  const double b = dot(direction, q) / det;
  if (!(b >= 0 && a + b <= 1)) return std::nullopt;
  return dot(v, q) / det;
}

/// Whether a line meets a box for some t in [from, to]; when in doubt it does.
bool meets(const Box& box, Vec3 origin, Vec3 direction, double from, double to) {
  const auto clip = [&](double low, double high, double at, double slope) {
    if (slope == 0) return low <= at && at <= high;
    const double s = (low - at) / slope, t = (high - at) / slope;
    from = std::max(from, std::min(s, t));
    const double end = std::max(s, t);
    to = std::min(to, end + 0x1p-50 * std::abs(end));
    return from <= to;
  };
  return clip(box.lower.x, box.upper.x, origin.x, direction.x) &&
         clip(box.lower.y, box.upper.y, origin.y, direction.y) &&
         clip(box.lower.z, box.upper.z, origin.z, direction.z);
}

}  // namespace

SurfaceTree::SurfaceTree(const TriangleMesh& mesh, Monitor& monitor)
    : tree_(boxes_of(mesh.vertices.span(), mesh.triangles.span()), 4, monitor) {
  triangles_.reserve(mesh.triangles.size());
  const auto vertex = [&](std::int32_t v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
  for (const auto& [u, v, w] : mesh.triangles) {
    const std::array<Vec3, 3> corners{vertex(u), vertex(v), vertex(w)};
    const Vec3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double norm = length(n);
    triangles_.push_back({corners, norm > 0 ? (1 / norm) * n : Vec3{}});
  }
}

std::optional<SurfacePoint> SurfaceTree::nearest(Vec3 p, double limit) const {
  std::optional<SurfacePoint> best;
  double least = limit;
  tree_.smallest(p, limit, -1, [&](std::size_t i) {
    const Item& item = triangles_[i];
    // Most triangles of a leaf are in planes that are too far away already.
    if (std::abs(dot(p - item.corners[0], item.normal)) * (1 - 1e-12) > least) return limit;
    const Vec3 q = nearest_on_triangle(p, item.corners);
    const double d = distance(p, q);
    const auto number = static_cast<std::int32_t>(i);
    if (d < least || (best && d == least && number < best->triangle)) {
      best = {q, number, d};
      least = d;
    }
    return d;
  });
  return best;
}

template <class Visit>
void SurfaceTree::along(Vec3 origin, Vec3 direction, double from, double to, const Visit& visit) const {
  const auto nodes = tree_.nodes();
  if (nodes.empty()) return;
  std::array<std::int32_t, 80> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::int32_t at = stack[--depth];
    const BoxTree::Node& node = nodes[static_cast<std::size_t>(at)];
    if (!meets(node.box, origin, direction, from, to)) continue;
    if (node.second != 0) {
      stack[depth++] = node.second;
      stack[depth++] = at + 1;
      continue;
    }
    for (std::int32_t k = node.first; k < node.last; ++k) {
      const std::int32_t triangle = tree_.order()[static_cast<std::size_t>(k)];
      const auto t = meeting(origin, direction, triangles_[static_cast<std::size_t>(triangle)].corners);
      if (t && *t > from && *t < to) visit(triangle, *t, to);
    }
  }
}

std::optional<SurfacePoint> SurfaceTree::first_hit(Vec3 origin, Vec3 direction, double from,
                                                   double to) const {
  std::optional<SurfacePoint> first;
  along(origin, direction, from, to, [&](std::int32_t triangle, double t, double& end) {
    first = {origin + t * direction, triangle, t};
    end = t;
  });
  return first;
}

std::vector<SurfacePoint> SurfaceTree::hits(Vec3 origin, Vec3 direction, double from, double to) const {
  std::vector<SurfacePoint> all;
  along(origin, direction, from, to, [&](std::int32_t triangle, double t, double&) {
    all.push_back({origin + t * direction, triangle, t});
  });
  return all;
}

}  // namespace ballflow::geometry
