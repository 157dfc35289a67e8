#include "search/solid_angles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/arctangent.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr std::size_t leaf_size = 4;

double farthest_corner(const Box& box, Vec3 from) {
  const Vec3 reach{std::max(from.x - box.lower.x, box.upper.x - from.x),
                   std::max(from.y - box.lower.y, box.upper.y - from.y),
                   std::max(from.z - box.lower.z, box.upper.z - from.z)};
  return length(reach);
}

}  // namespace

double solid_angle_fraction(Vec3 a, Vec3 b, Vec3 c, Vec3 point) {
  const Vec3 u = a - point, v = b - point, w = c - point;
  const double lu = length(u), lv = length(v), lw = length(w);
  const double numerator = dot(u, cross(v, w));
  const double denominator = lu * lv * lw + dot(u, v) * lw + dot(v, w) * lu + dot(w, u) * lv;
  return arctangent(numerator, denominator) / (2 * pi);
}

SolidAngles::SolidAngles(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                         Monitor& monitor) {
  if (triangles.empty()) return;
  const BoxTree tree(boxes_of(vertices, triangles), leaf_size, monitor);
  const std::vector<std::int32_t>& order = tree.order();
  nodes_.resize(tree.nodes().size());
  corners_.resize(triangles.size());
  const auto corner = [&](std::int32_t t, std::size_t k) { return vertices[at(triangles[at(t)][k])]; };
  const auto leaf = [&](std::size_t index, const Box& box, std::size_t first, std::size_t last) {
    Node& node = nodes_[index];
    node.link = static_cast<std::int32_t>(first);
    node.count = static_cast<std::int32_t>(last - first);
    Vec3 weighted;
    for (std::size_t i = first; i < last; ++i) {
      Corners& t = corners_[i];
      t.a = corner(order[i], 0), t.b = corner(order[i], 1), t.c = corner(order[i], 2);
      t.normal = 0.5 * cross(t.b - t.a, t.c - t.a);
      t.area = length(t.normal);
      t.centroid = 1.0 / 3 * (t.a + t.b + t.c);
      t.radius = std::max({distance(t.a, t.centroid), distance(t.b, t.centroid), distance(t.c, t.centroid)});
      node.normal = node.normal + t.normal;
      node.area += t.area;
      weighted = weighted + t.area * t.centroid;
    }
    node.centroid = node.area > 0 ? 1 / node.area * weighted : 0.5 * (box.lower + box.upper);
    node.radius = farthest_corner(box, node.centroid);
  };
  const auto inner = [&](std::size_t index, const Box& box, std::size_t second) {
    const Node &p = nodes_[index + 1], &q = nodes_[second];
    Node& node = nodes_[index];
    node.link = static_cast<std::int32_t>(second);
    node.normal = p.normal + q.normal;
    node.area = p.area + q.area;
    node.centroid = node.area > 0 ? 1 / node.area * (p.area * p.centroid + q.area * q.centroid)
                                  : 0.5 * (box.lower + box.upper);
    node.radius = farthest_corner(box, node.centroid);
  };
  for (std::size_t index = nodes_.size(); index-- > 0;) {  // children before their parents
    const auto& [box, first, last, second] = tree.nodes()[index];
    if (second == 0) {
      leaf(index, box, static_cast<std::size_t>(first), static_cast<std::size_t>(last));
    } else {
      inner(index, box, static_cast<std::size_t>(second));
    }
  }
}

SolidAngles::Sum SolidAngles::sum(Vec3 point, double tolerance) const {
  Sum total;
  if (!nodes_.empty()) add(0, point, tolerance, total);
  return total;
}

// Leaves the cluster out or adds it as a dipole when that is exact enough. Every cluster may take a share of
// the tolerance in proportion to its area.
bool SolidAngles::add_far(const Cluster& cluster, Vec3 point, double tolerance, Sum& sum) const {
  const Vec3 to = cluster.centroid - point;
  const double d = length(to);
  const double gap = d - cluster.radius;
  if (!(gap > 0 && tolerance > 0)) return false;
  const double sphere = 4 * pi * gap * gap;
  if (nodes_[0].area <= tolerance * sphere) {
    sum.error += cluster.area / sphere;
    return true;
  }
  if (!(cluster.radius * nodes_[0].area <= tolerance * 2 * pi * gap * gap * gap)) return false;
  sum.value += dot(cluster.normal, to) / (4 * pi * d * d * d);
  sum.error += cluster.area * cluster.radius / (2 * pi * gap * gap * gap);
  return true;
}

void SolidAngles::add(std::int32_t index, Vec3 point, double tolerance, Sum& sum) const {
  const Node& node = nodes_[at(index)];
  if (add_far(node, point, tolerance, sum)) return;
  if (node.count == 0) {
    add(index + 1, point, tolerance, sum);
    add(node.link, point, tolerance, sum);
    return;
  }
  for (std::int32_t k = node.link; k < node.link + node.count; ++k) {
    const Corners& t = corners_[at(k)];
    if (!add_far(t, point, tolerance, sum)) sum.value += solid_angle_fraction(t.a, t.b, t.c, point);
  }
}

}  // namespace ballflow::geometry
