#include "search/surface_tree.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "search/nearest_on_triangle.hpp"

namespace ballflow::geometry {
namespace {

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

/// A line and, so that boxes need no division, one over its direction.
struct Line {
  Line(Vec3 from, Vec3 along)
      : origin(from), direction(along), inverse{1 / along.x, 1 / along.y, 1 / along.z} {}
  Vec3 origin, direction, inverse;
};

/// Whether a line meets a box for some t in [from, to]; when in doubt it does.
bool meets(const Box& box, const Line& line, double from, double to) {
  const auto clip = [&](double low, double high, double at, double slope, double inverse) {
    if (slope == 0) return low <= at && at <= high;
    if (!std::isfinite(inverse)) return true;
    const double s = (low - at) * inverse, t = (high - at) * inverse;
    from = std::max(from, std::min(s, t));
    const double end = std::max(s, t);
    to = std::min(to, end + 0x1p-49 * std::abs(end));  // four times the rounding of either end
    return from <= to;
  };
  return clip(box.lower.x, box.upper.x, line.origin.x, line.direction.x, line.inverse.x) &&
         clip(box.lower.y, box.upper.y, line.origin.y, line.direction.y, line.inverse.y) &&
         clip(box.lower.z, box.upper.z, line.origin.z, line.direction.z, line.inverse.z);
}

}  // namespace

SurfaceTree::SurfaceTree(const TriangleMesh& mesh, Monitor& monitor)
    : tree_(boxes_of(mesh.vertices.span(), mesh.triangles.span()), 4, monitor) {
  items_.reserve(mesh.triangles.size());
  place_.resize(mesh.triangles.size());
  const auto vertex = [&](std::int32_t v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
  for (const std::int32_t triangle : tree_.order()) {
    place_[static_cast<std::size_t>(triangle)] = items_.size();
    const auto& [u, v, w] = mesh.triangles[static_cast<std::size_t>(triangle)];
    const std::array<Vec3, 3> corners{vertex(u), vertex(v), vertex(w)};
    const Vec3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double norm = length(n);
    items_.push_back({corners, norm > 0 ? (1 / norm) * n : Vec3{}, triangle});
    for (const Vec3& c : corners) reach_ = std::max({reach_, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  }
  make_slabs();
}

void SurfaceTree::make_slabs() {
  const auto nodes = tree_.nodes();
  slabs_.resize(nodes.size());
  tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t at) {
    const BoxTree::Node& node = nodes[at];
    const auto for_each_item = [&](const auto& visit) {
      for (std::int32_t k = node.first; k < node.last; ++k) visit(items_[static_cast<std::size_t>(k)]);
    };
    Vec3 sum;
    for_each_item([&](const Item& item) {
      const auto& [a, b, c] = item.corners;
      sum = sum + cross(b - a, c - a);
    });
    const double norm = length(sum);
    if (!(norm > 0) || !std::isfinite(norm)) return;  // all space
    Slab slab{(1 / norm) * sum, std::numeric_limits<double>::infinity(),
              -std::numeric_limits<double>::infinity()};
    for_each_item([&](const Item& item) {
      for (const Vec3& c : item.corners) {
        const double at_corner = dot(slab.normal, c);
        slab.low = std::min(slab.low, at_corner);
        slab.high = std::max(slab.high, at_corner);
      }
    });
    slabs_[at] = slab;
  });
}

/// Nothing of the node is nearer; `slack` is more than the rounding of heights over a slab.
double SurfaceTree::bound(std::size_t node, Vec3 p, double slack) const {
  const Slab& slab = slabs_[node];
  const double height = dot(slab.normal, p);
  return std::max(distance_to_box(tree_.nodes()[node].box, p),
                  std::max(height - slab.high, slab.low - height) - slack);
}

std::optional<SurfacePoint> SurfaceTree::nearest(Vec3 p, double limit) const {
  std::optional<SurfacePoint> best;
  const auto nodes = tree_.nodes();
  if (nodes.empty()) return best;
  const double slack = 0x1p-48 * (reach_ + std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
  double least = limit;
  const auto look_at = [&](const Item& item) {
    // Most triangles of a leaf are in planes that are too far away already.
    if (std::abs(dot(p - item.corners[0], item.normal)) * (1 - 1e-12) > least) return;
    const Vec3 q = nearest_on_triangle(p, item.corners);
    const double d = distance(p, q);
    if (d < least || (best && d == least && item.triangle < best->triangle)) {
      best = {q, item.triangle, d};
      least = d;
    }
  };
  std::array<std::pair<double, std::size_t>, 80> stack;  // the size halves at every level
  std::size_t depth = 0;
  stack[depth++] = {bound(0, p, slack), 0};
  while (depth > 0) {
    const auto [nearest, at] = stack[--depth];
    if (nearest > least || (nearest == least && !best)) continue;  // equally near ones may have lower numbers
    const BoxTree::Node& node = nodes[at];
    if (node.second == 0) {
      for (std::int32_t k = node.first; k < node.last; ++k) look_at(items_[static_cast<std::size_t>(k)]);
      continue;
    }
    const auto second = static_cast<std::size_t>(node.second);
    std::pair<double, std::size_t> near{bound(at + 1, p, slack), at + 1},
        far{bound(second, p, slack), second};
    if (far.first < near.first) std::swap(near, far);
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return best;
}

template <class Visit>
void SurfaceTree::along(Vec3 origin, Vec3 direction, double from, double to, const Visit& visit) const {
  const auto nodes = tree_.nodes();
  if (nodes.empty()) return;
  const Line line(origin, direction);
  std::array<std::int32_t, 80> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::int32_t at = stack[--depth];
    const BoxTree::Node& node = nodes[static_cast<std::size_t>(at)];
    if (!meets(node.box, line, from, to)) continue;
    if (node.second != 0) {
      stack[depth++] = node.second;
      stack[depth++] = at + 1;
      continue;
    }
    for (std::int32_t k = node.first; k < node.last; ++k) {
      const Item& item = items_[static_cast<std::size_t>(k)];
      const auto t = meeting(origin, direction, item.corners);
      if (t && *t > from && *t < to) visit(item.triangle, *t, to);
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
