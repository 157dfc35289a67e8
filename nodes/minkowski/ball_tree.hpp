// An octree of balls, a quadtree of discs, each node with a small ball around all that are in it
// (thesis, 5.3.2).
#pragma once

#include <cstdint>
#include <vector>

#include "minkowski/sums.hpp"

namespace ballflow::geometry {

struct BallTreeNode {
  Ball bound;                             // around all balls below, also after a ball was added to both
  Ball largest;                           // one of these
  std::vector<Ball> balls;                // of leaves, the largest first
  std::int32_t children = -1, next = -1;  // the first child; the node after all that are below this one
  std::int64_t count = 0;                 // of balls below
};

/// In preorder: children follow their parent. Leaves have at most `leaf_size` balls, more only at one place.
/// The bounds are smallest enclosing balls (CGAL), widened by what rounding a sum can push a ball out.
std::vector<BallTreeNode> ball_tree(const Balls& balls, std::size_t leaf_size);

}  // namespace ballflow::geometry
