// A balanced binary tree over triangles.
#pragma once

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Splits triangles at the median of the middles of their boxes, along the longest extent. Ties are broken by
/// index, so the tree is a function of its input and of nothing else. Nodes are numbered in preorder: the
/// first child of node i is i + 1.
class MedianTree {
 public:
  static constexpr std::size_t leaf_size = 4;

  MedianTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles, Monitor& monitor)
      : boxes(triangles.size()), order(triangles.size()), monitor_(monitor) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (const std::int32_t v : triangles[t]) boxes[t].add(vertices[static_cast<std::size_t>(v)]);
    }
    std::iota(order.begin(), order.end(), 0);
  }

  static std::size_t size(std::size_t count) {
    return count <= leaf_size ? 1 : 1 + size(count / 2) + size(count - count / 2);
  }

  // Arranges order[first, last); calls leaf(node, box, first, last) and inner(node, box, second child).
  template <class Leaf, class Inner>
  Box build(std::size_t node, std::size_t first, std::size_t last, const Leaf& leaf, const Inner& inner) {
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(last);
    if (last - first <= leaf_size) {
      std::sort(begin, end);
      Box box;
      for (auto t = begin; t != end; ++t) {
        box.add(boxes[static_cast<std::size_t>(*t)].lower);
        box.add(boxes[static_cast<std::size_t>(*t)].upper);
      }
      leaf(node, box, first, last);
      return box;
    }
    if (monitor_.cancelled()) throw Cancelled();
    Box middles;
    for (auto t = begin; t != end; ++t) middles.add(middle(*t));
    const Vec3 extent = middles.upper - middles.lower;
    double Vec3::*axis = &Vec3::x;
    if (extent.y > extent.x) axis = &Vec3::y;
    if (extent.z > extent.*axis) axis = &Vec3::z;
    const std::size_t half = (last - first) / 2;
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half), end,
                     [&](std::int32_t a, std::int32_t b) {
                       const double u = middle(a).*axis, v = middle(b).*axis;
                       return u != v ? u < v : a < b;
                     });
    const std::size_t second = node + 1 + size(half);
    Box box, other;
    const auto build_first = [&] { box = build(node + 1, first, first + half, leaf, inner); };
    const auto build_second = [&] { other = build(second, first + half, last, leaf, inner); };
    if (last - first > 8192) {
      tbb::parallel_invoke(build_first, build_second);
    } else {
      build_first();
      build_second();
    }
    box.add(other.lower);
    box.add(other.upper);
    inner(node, box, second);
    return box;
  }

  std::vector<Box> boxes;
  std::vector<std::int32_t> order;

 private:
  Vec3 middle(std::int32_t t) const {
    const Box& box = boxes[static_cast<std::size_t>(t)];
    return box.lower + box.upper;
  }
  Monitor& monitor_;
};

}  // namespace ballflow::geometry
