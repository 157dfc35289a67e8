// A quadtree of discs, each node with a small disc around all that are in it (thesis, 5.3.2).
#pragma once

#include <cstdint>
#include <vector>

#include "minkowski/sums.hpp"

namespace ballflow::geometry {

struct DiscTreeNode {
  Ball bound;                             // around all discs below, also after a disc was added to both
  Ball largest;                           // one of these
  std::vector<Ball> discs;                // of leaves, without the largest
  std::int32_t children = -1, next = -1;  // the first child; the node after all that are below this one
  std::int64_t count = 0;                 // of discs below
};

/// In preorder: children follow their parent. Leaves have at most `leaf_size` discs, more only at one place.
/// The bounds are smallest enclosing discs (CGAL), widened by what rounding a sum can push a disc out.
std::vector<DiscTreeNode> disc_tree(const Balls& discs, std::size_t leaf_size);

}  // namespace ballflow::geometry
