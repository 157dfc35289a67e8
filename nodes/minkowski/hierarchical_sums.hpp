// Sums found down a tree of balls around balls (thesis, 5.3.2), in space and in the plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/memory.hpp"
#include "base/space_order.hpp"
#include "minkowski/ball_tree.hpp"
#include "minkowski/sum_lists.hpp"

namespace ballflow::geometry {

struct HierarchyOptions {
  std::size_t leaf_size;
  // Sums in leaves are inserted as soon as they are found, which is quick in the plane, or all at the end, in
  // an order that is quick in space.
  bool at_once;
  double bytes_per_sum, bytes_per_vertex;
};

/// The tree is over the larger set. First come the sums with the largest ball of every leaf, together, which
/// hide most others. Then every ball of the smaller set goes down the tree, level by level, as long as its
/// sum with the ball around a node may contribute: if that contributes nothing, neither do the sums below,
/// since in a ball inside another one the power to the other is not larger. The questions of a level are
/// asked in the order of a curve through space, so that the place of one is near that of the one before.
template <class Triangulation>
class HierarchicalSums {
 public:
  HierarchicalSums(const Balls& a, const Balls& b, Triangulation& triangulation,
                   const HierarchyOptions& options)
      : small_(a.size() < b.size() ? a : b),
        tree_(ball_tree(a.size() < b.size() ? b : a, options.leaf_size)),
        triangulation_(triangulation),
        options_(options) {}

  /// Inserts what may contribute; returns how many pairs were looked at.
  std::int64_t run(Monitor& monitor) {
    const MemoryLimit memory(monitor);
    std::int64_t leaves = 0;
    for (const BallTreeNode& node : tree_) leaves += node.children < 0;
    const std::int64_t first_sums = leaves * static_cast<std::int64_t>(small_.size());
    require_memory(first_sums, options_.bytes_per_sum, memory);
    std::vector<Ball> sums;
    sums.reserve(static_cast<std::size_t>(first_sums));
    for (std::size_t i = 0; i < small_.size(); ++i) {
      for (const BallTreeNode& node : tree_) {
        if (node.children < 0) sums.push_back(ball(i) + node.largest);
      }
    }
    PartMonitor part(monitor, 0, 0.4);
    triangulation_.insert(std::move(sums), part);
    return first_sums + insert_below(memory, monitor);
  }

 private:
  Ball ball(std::size_t i) const { return {small_.centers[i], small_.radii[i]}; }

  // Nodes with more balls are entered without a question: hardly any of them is passed by.
  static constexpr std::int64_t asked_size = 64;

  struct Question {
    Ball bound;  // around the sums of a ball of the smaller set and those below a node
    std::int32_t ball, node;
  };

  Question question(std::int32_t at, std::int32_t node) const {
    Ball one = ball(static_cast<std::size_t>(at));
    // By more than what rounding a sum can push it out.
    one.radius +=
        0x1p-48 * (one.radius + std::abs(one.center.x) + std::abs(one.center.y) + std::abs(one.center.z));
    return {one + tree_[static_cast<std::size_t>(node)].bound, at, node};
  }

  /// Inserts the sums in leaves that may contribute, but those with the largest ball of each; how many.
  std::int64_t insert_below(const MemoryLimit& memory, Monitor& monitor) {
    std::int64_t inserted = 0;
    std::vector<Ball> found;
    std::vector<Question> level, next;
    for (std::size_t i = 0; i < small_.size(); ++i)
      level.push_back(question(static_cast<std::int32_t>(i), 0));
    Lookout look(monitor);
    while (!level.empty()) {
      next.clear();
      for (const std::uint32_t k : along_curve(level)) {
        look(512);
        const Question& q = level[k];
        const BallTreeNode& node = tree_[static_cast<std::size_t>(q.node)];
        if (node.count <= asked_size && !triangulation_.may_contribute(q.bound)) continue;
        const Ball one = ball(static_cast<std::size_t>(q.ball));
        for (const Ball& other : node.balls) {
          if (options_.at_once) {
            triangulation_.insert(one + other);
          } else {
            found.push_back(one + other);
          }
        }
        inserted += static_cast<std::int64_t>(node.balls.size());
        if (node.children < 0) continue;
        for (std::int32_t child = node.children; child != node.next;
             child = tree_[static_cast<std::size_t>(child)].next)
          next.push_back(question(q.ball, child));
      }
      std::swap(level, next);
      require_memory(static_cast<std::int64_t>(triangulation_.vertices()), options_.bytes_per_vertex, memory);
      require_memory(static_cast<std::int64_t>(found.size()), options_.bytes_per_sum, memory);
    }
    PartMonitor rest(monitor, 0.6, 0.9);
    triangulation_.insert(std::move(found), rest);
    return inserted;
  }

  static std::vector<std::uint32_t> along_curve(const std::vector<Question>& level) {
    Box box;
    for (const Question& q : level) box.add(q.bound.center);
    const SpaceOrder place(box);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(level.size());
    for (std::size_t i = 0; i < level.size(); ++i)
      order[i] = {place(level[i].bound.center), static_cast<std::uint32_t>(i)};
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> result;
    result.reserve(order.size());
    for (const auto& [key, i] : order) result.push_back(i);
    return result;
  }

  const Balls& small_;
  const std::vector<BallTreeNode> tree_;
  Triangulation& triangulation_;
  const HierarchyOptions options_;
};

}  // namespace ballflow::geometry
