// A tree of bounding boxes that finds the item of smallest value at a point, for balls, triangles and points.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/vec3.hpp"

namespace ballflow::geometry {

class NearestTree {
 public:
  NearestTree() = default;
  /// The value of item i at a point p will be at least the distance of p and boxes[i], less slacks[i], which
  /// may be negative. Without slacks they are 0.
  explicit NearestTree(std::span<const Box> boxes, std::span<const double> slacks = {}) : ids_(boxes.size()) {
    std::iota(ids_.begin(), ids_.end(), 0);
    if (!boxes.empty()) build(boxes, slacks, 0, static_cast<std::int32_t>(boxes.size()));
  }

  /// The smallest value(i) of all items, or `limit` where none is below it. Once a value is at most `enough`,
  /// it is returned, the smallest or not.
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
      if (node.right == 0) {
        for (std::int32_t k = node.first; k < node.last; ++k) {
          limit = std::min(limit, value(static_cast<std::size_t>(ids_[static_cast<std::size_t>(k)])));
        }
        if (limit <= enough) return limit;
        continue;
      }
      std::pair<double, std::int32_t> near{bound(at + 1, p), at + 1}, far{bound(node.right, p), node.right};
      if (far.first < near.first) std::swap(near, far);
      stack[depth++] = far;
      stack[depth++] = near;
    }
    return limit;
  }

  /// Calls visit(i) for all items whose value at p may be below `limit`.
  template <class Visit>
  void below(Vec3 p, double limit, Visit visit) const {
    for (std::int32_t at = 0; at < static_cast<std::int32_t>(nodes_.size());) {
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      const bool out = bound(at, p) >= limit;
      if (!out && node.right == 0) {
        for (std::int32_t k = node.first; k < node.last; ++k) {
          visit(static_cast<std::size_t>(ids_[static_cast<std::size_t>(k)]));
        }
      }
      at = out ? node.next : at + 1;
    }
  }

 private:
  struct Node {
    Box box;
    double slack;
    std::int32_t first, last;
    std::int32_t right;  // 0 for a leaf; the left child follows its parent
    std::int32_t next;   // the first node behind this one and all below it
  };

  double bound(std::int32_t at, Vec3 p) const {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    const auto outside = [](double low, double high) { return std::max(std::max(low, high), 0.0); };
    const Vec3 low = node.box.lower - p, high = p - node.box.upper;
    return length({outside(low.x, high.x), outside(low.y, high.y), outside(low.z, high.z)}) - node.slack;
  }

  void build(std::span<const Box> boxes, std::span<const double> slacks, std::int32_t first,
             std::int32_t last) {
    constexpr std::int32_t leaf_size = 8;
    Node node{
        {},    slacks.empty() ? 0 : slacks[static_cast<std::size_t>(ids_[static_cast<std::size_t>(first)])],
        first, last,
        0,     0};
    for (std::int32_t k = first; k < last; ++k) {
      const auto i = static_cast<std::size_t>(ids_[static_cast<std::size_t>(k)]);
      node.box.add(boxes[i].lower);
      node.box.add(boxes[i].upper);
      if (!slacks.empty()) node.slack = std::max(node.slack, slacks[i]);
    }
    const std::size_t self = nodes_.size();
    nodes_.push_back(node);
    if (last - first <= leaf_size) {
      nodes_[self].next = static_cast<std::int32_t>(nodes_.size());
      return;
    }
    const Vec3 extent = node.box.upper - node.box.lower;
    double Vec3::*axis = &Vec3::x;
    if (extent.y > extent.*axis) axis = &Vec3::y;
    if (extent.z > extent.*axis) axis = &Vec3::z;
    const std::int32_t middle = first + (last - first) / 2;
    std::nth_element(ids_.begin() + first, ids_.begin() + middle, ids_.begin() + last,
                     [&](std::int32_t a, std::int32_t b) {
                       const Box &s = boxes[static_cast<std::size_t>(a)],
                                 &t = boxes[static_cast<std::size_t>(b)];
                       return s.lower.*axis + s.upper.*axis < t.lower.*axis + t.upper.*axis;
                     });
    build(boxes, slacks, first, middle);
    nodes_[self].right = static_cast<std::int32_t>(nodes_.size());
    build(boxes, slacks, middle, last);
    nodes_[self].next = static_cast<std::int32_t>(nodes_.size());
  }

  std::vector<Node> nodes_;
  std::vector<std::int32_t> ids_;
};

}  // namespace ballflow::geometry
