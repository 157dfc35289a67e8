// Sums of pairs of balls, without those below pairs of nodes of trees of balls around balls (thesis, 5.3.2),
// in space and in the plane.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/memory.hpp"
#include "base/space_order.hpp"
#include "minkowski/ball_tree.hpp"
#include "minkowski/containment_filter.hpp"
#include "minkowski/sum_lists.hpp"

namespace ballflow::geometry {

struct HierarchyOptions {
  double bytes_per_sum, bytes_per_vertex;
  std::size_t leaf_size = 4;
  // Blocks of so many sums are worth a question to the triangulation when this part of them is passed by.
  std::size_t asked_size = 12;
  double worth = 0.25;
};

/// Both sets have a tree, and a pair of nodes stands for all sums of what is below: they lie in the sum of
/// the balls around the nodes. When that contributes nothing, neither do they, since in a ball inside another
/// one the power to the other is not larger. Two questions are asked, the cheap one first:
/// - Down both trees, whether a grid of large sums knows one that contains the ball (ContainmentFilter).
/// - Whether the ball around a block of sums that are left, each that of two leaves, has a cell that meets it
///   among the neighbors that it would have in the triangulation of one in eight of all: it is neither
///   inserted nor removed. A few blocks are tried first: mostly the grid has left too little to pass by.
template <class Triangulation>
class HierarchicalSums {
 public:
  HierarchicalSums(const Balls& a, const Balls& b, Triangulation& triangulation,
                   const HierarchyOptions& options)
      : one_(ball_tree(a, leaf_size(a, b, options))),
        other_(ball_tree(b, leaf_size(a, b, options))),
        filter_(box_of_sums(a, b),
                filter_voxels(static_cast<double>(a.size()) * static_cast<double>(b.size()))),
        triangulation_(triangulation),
        options_(options) {}

  /// Inserts what may contribute; returns how many sums.
  std::int64_t run(Monitor& monitor) {
    fill_filter(monitor);
    monitor.step(0.05);
    const MemoryLimit memory(monitor);
    Lookout look(monitor);
    descend(one_[0], other_[0], memory, look);
    monitor.step(0.15);
    const std::vector<std::uint32_t> asked = along_curve();
    if (!asked.empty()) {
      insert_some(64, monitor);
      if (is_worth_asking(asked)) {
        insert_some(8, monitor);
        pass_by_blocks(asked, look);
      }
    }
    require_memory(static_cast<std::int64_t>(triangulation_.vertices()), options_.bytes_per_vertex, memory);
    PartMonitor rest(monitor, 0.4, 0.9);
    const auto inserted = static_cast<std::int64_t>(sums_.size()) + inserted_;
    triangulation_.insert(std::move(sums_), rest);
    return inserted;
  }

 private:
  struct Block {
    Ball bound;
    std::size_t first, last;  // of sums_
  };

  /// An offset, by a ball or a few, has too few sums for trees to pay.
  static std::size_t leaf_size(const Balls& a, const Balls& b, const HierarchyOptions& options) {
    const std::size_t balls = a.size() + b.size();
    return a.size() * b.size() < 8 * balls ? balls : options.leaf_size;
  }

  static Box box_of_sums(const Balls& a, const Balls& b) {
    const Box of_a = bounding_box(a.centers), of_b = bounding_box(b.centers);
    Box box;
    box.add(of_a.lower + of_b.lower);
    box.add(of_a.upper + of_b.upper);
    return box;
  }

  void fill_filter(Monitor& monitor) {
    Lookout look(monitor);
    for (const BallTreeNode& p : one_) {
      if (p.children >= 0) continue;
      for (const BallTreeNode& q : other_) {
        if (q.children >= 0) continue;
        look(16 * (p.balls.size() + q.balls.size()));
        for (const Ball& ball : p.balls) filter_.offer(ball + q.largest);
        for (const Ball& ball : q.balls) filter_.offer(p.largest + ball);
      }
    }
    filter_.spread(monitor);
  }

  void descend(const BallTreeNode& p, const BallTreeNode& q, const MemoryLimit& memory, Lookout& look) {
    look(64);
    const Ball bound = p.bound + q.bound;
    if (filter_.contains(bound)) return;
    const bool split_p = p.children >= 0 && (q.children < 0 || p.bound.radius >= q.bound.radius);
    if (split_p || q.children >= 0) {
      const std::vector<BallTreeNode>& tree = split_p ? one_ : other_;
      const BallTreeNode& parent = split_p ? p : q;
      for (std::int32_t child = parent.children; child != parent.next;) {
        const BallTreeNode& node = tree[static_cast<std::size_t>(child)];
        child = node.next;
        if (split_p) {
          descend(node, q, memory, look);
        } else {
          descend(p, node, memory, look);
        }
      }
      return;
    }
    look(16 * p.balls.size() * q.balls.size());
    const std::size_t first = sums_.size();
    for (const Ball& a : p.balls) {
      for (const Ball& b : q.balls) {
        const Ball sum = a + b;
        if (!filter_.contains(sum)) sums_.push_back(sum);
      }
    }
    if (sums_.size() == first) return;
    require_memory(static_cast<std::int64_t>(sums_.size()), options_.bytes_per_sum, memory);
    blocks_.push_back({bound, first, sums_.size()});
  }

  /// One in `stride` of the sums, spread evenly, which the others are asked against.
  void insert_some(std::size_t stride, Monitor& monitor) {
    std::vector<Ball> some;
    some.reserve(sums_.size() / stride + 1);
    std::size_t end = 0;
    for (Block& block : blocks_) {
      const std::size_t first = end;
      for (std::size_t i = block.first; i < block.last; ++i) {
        if (i % stride == 0) {
          some.push_back(sums_[i]);
        } else {
          sums_[end++] = sums_[i];
        }
      }
      block.first = first, block.last = end;
    }
    sums_.resize(end);
    inserted_ += static_cast<std::int64_t>(some.size());
    PartMonitor part(monitor, stride == 8 ? 0.2 : 0.15, stride == 8 ? 0.3 : 0.2);
    triangulation_.insert(std::move(some), part);
  }

  /// Some questions tell whether all of them pass by more than they cost: seldom so where the grid was asked
  /// before, since a ball around a block is larger than what is in it, and its cell too.
  bool is_worth_asking(const std::vector<std::uint32_t>& asked) {
    constexpr std::size_t trials = 256;
    std::size_t tried = 0, passed_by = 0;
    for (std::size_t i = 0; i < asked.size(); i += asked.size() / trials + 1, ++tried)
      passed_by += !triangulation_.may_contribute(blocks_[asked[i]].bound);
    return static_cast<double>(passed_by) >= options_.worth * static_cast<double>(tried);
  }

  /// Takes the sums out of sums_ that need not be inserted any more.
  void pass_by_blocks(const std::vector<std::uint32_t>& asked, Lookout& look) {
    std::vector<std::uint8_t> gone(blocks_.size());
    for (const std::uint32_t k : asked) {
      look(512);
      gone[k] = !triangulation_.may_contribute(blocks_[k].bound);
    }
    std::size_t end = 0;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      if (gone[k]) continue;
      for (std::size_t i = blocks_[k].first; i < blocks_[k].last; ++i) sums_[end++] = sums_[i];
    }
    sums_.resize(end);
  }

  std::vector<std::uint32_t> along_curve() const {
    Box box;
    for (const Block& block : blocks_) box.add(block.bound.center);
    const SpaceOrder place(box);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      if (blocks_[k].last - blocks_[k].first >= options_.asked_size)
        order.emplace_back(place(blocks_[k].bound.center), static_cast<std::uint32_t>(k));
    }
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> result;
    result.reserve(order.size());
    for (const auto& [key, k] : order) result.push_back(k);
    return result;
  }

  const std::vector<BallTreeNode> one_, other_;
  ContainmentFilter filter_;
  Triangulation& triangulation_;
  const HierarchyOptions options_;
  std::vector<Ball> sums_;
  std::vector<Block> blocks_;
  std::int64_t inserted_ = 0;
};

}  // namespace ballflow::geometry
