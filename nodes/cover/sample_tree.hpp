// A kd-tree of samples for ball queries whose answers are those of the membership predicate, bit for bit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "types/vec3.hpp"

namespace ballflow::geometry {

class SampleTree {
 public:
  /// Samples are finite; there may be none. At most 2^31 - 1.
  explicit SampleTree(std::span<const Vec3> samples);

  /// Number of samples s with in_reach(center, squared_reach, s).
  std::int64_t count(Vec3 center, double squared_reach) const;

  /// Writes the indices of these samples to `out`, in no particular order; returns one past the last. `out`
  /// has room for `margin` indices more than the answer has.
  std::int32_t* find(Vec3 center, double squared_reach, std::int32_t* out) const;

  static constexpr std::size_t margin = 32;

  /// All samples, neighbours in space near each other: queries in this order find their nodes in the cache.
  const std::vector<std::int32_t>& order() const { return ids_; }

 private:
  struct Node {
    Vec3 lower, upper;         // bounding box of its samples
    std::int32_t first, last;  // its samples, positions in tree order
    std::int32_t right;        // right child, 0 for a leaf; the left child follows its parent
  };

  void build(std::span<const Vec3> samples, std::int32_t first, std::int32_t last);
  template <class Whole, class Leaf>
  void descend(Vec3 center, double squared_reach, Whole whole, Leaf leaf) const;

  std::vector<Node> nodes_;
  std::vector<std::int32_t> ids_;  // samples in tree order
  std::vector<double> x_, y_, z_;  // their coordinates, in tree order
};

}  // namespace ballflow::geometry
