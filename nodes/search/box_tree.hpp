// A balanced tree of bounding boxes, for balls, triangles and points.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// The distance of a point to a box, 0 inside. Rounding keeps the order of boxes inside each other: a box is
/// never farther than one that it contains, nor than a point in it, whose distance() is rounded in the same
/// way.
inline double distance_to_box(const Box& box, Vec3 p) {
  const auto outside = [](double low, double high) { return std::max(std::max(low, high), 0.0); };
  const Vec3 low = box.lower - p, high = p - box.upper;
  return length({outside(low.x, high.x), outside(low.y, high.y), outside(low.z, high.z)});
}

/// The bounding box of each triangle.
inline std::vector<Box> boxes_of(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  std::vector<Box> boxes(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::int32_t v : triangles[t]) boxes[t].add(vertices[static_cast<std::size_t>(v)]);
  }
  return boxes;
}

/// Splits items at the median of the middles of their boxes, along the longest extent. Ties are broken by
/// index, so the tree is a function of its input and of nothing else.
class BoxTree {
 public:
  static constexpr std::size_t default_leaf_size = 8;

  /// Nodes are in preorder: the first child of an inner node follows it.
  struct Node {
    Box box;
    std::int32_t first, last;  // its items, places in order()
    std::int32_t second;       // the second child; 0 for a leaf
  };

  BoxTree() = default;
  /// Fewer than 2^31 items, each in the box of its number. A leaf has at most `leaf_size` of them.
  explicit BoxTree(std::span<const Box> boxes, std::size_t leaf_size = default_leaf_size,
                   Monitor& monitor = no_monitor());
  explicit BoxTree(std::span<const Vec3> points, std::size_t leaf_size = default_leaf_size,
                   Monitor& monitor = no_monitor());

  std::span<const Node> nodes() const { return nodes_; }
  /// The items, those of a node side by side, of a leaf ascending.
  const std::vector<std::int32_t>& order() const { return order_; }

  /// Allows the value of item i at a point to be as much as slacks[i], which may be negative, below the
  /// distance of its box. Without slacks they are 0.
  void set_slacks(std::span<const double> slacks);

  /// The smallest value(i) of all items, or `limit` where none is below it. Once a value is below `enough`,
  /// some value below `enough` is returned, the smallest or not. Precondition: value(i) >=
  /// distance_to_box(boxes[i], p) - slacks[i] as it is rounded. Then the result, where it is not below
  /// `enough`, is a function of the items alone: it does not depend on their order.
  template <class Value>
  double smallest(Vec3 p, double limit, double enough, Value value) const {
    if (nodes_.empty()) return limit;
    std::array<std::pair<double, std::int32_t>, 80> stack;  // the size halves at every level
    std::size_t depth = 0;
    stack[depth++] = {bound(0, p), 0};
    while (depth > 0) {
      const auto [least, at] = stack[--depth];
      if (least >= limit) continue;
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      if (node.second == 0) {
        for (std::int32_t k = node.first; k < node.last; ++k) limit = std::min(limit, value(item(k)));
        if (limit < enough) return limit;
        continue;
      }
      std::pair<double, std::int32_t> near{bound(at + 1, p), at + 1}, far{bound(node.second, p), node.second};
      if (far.first < near.first) std::swap(near, far);
      stack[depth++] = far;
      stack[depth++] = near;
    }
    return limit;
  }

  /// Calls visit(i) for all items whose value at p may be below `limit`, and perhaps for some others.
  template <class Visit>
  void below(Vec3 p, double limit, Visit visit) const {
    if (nodes_.empty()) return;
    std::array<std::int32_t, 80> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::int32_t at = stack[--depth];
      if (bound(at, p) >= limit) continue;
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      if (node.second == 0) {
        for (std::int32_t k = node.first; k < node.last; ++k) visit(item(k));
        continue;
      }
      stack[depth++] = node.second;
      stack[depth++] = at + 1;
    }
  }

 private:
  std::size_t item(std::int32_t k) const {
    return static_cast<std::size_t>(order_[static_cast<std::size_t>(k)]);
  }
  double bound(std::int32_t at, Vec3 p) const {
    const auto node = static_cast<std::size_t>(at);
    return distance_to_box(nodes_[node].box, p) - (slacks_.empty() ? 0 : slacks_[node]);
  }

  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;
  std::vector<double> slacks_;  // per node the largest of its items; or empty
};

}  // namespace ballflow::geometry
