// A kd-tree of samples for ball queries whose answers are those of the membership predicate, bit for bit.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace ballflow::geometry {

class SampleTree {
 public:
  /// Samples are finite; there may be none. At most 2^31 - 1.
  explicit SampleTree(std::span<const Vec3> samples);

  /// Part of an answer: all samples of a node, or those of a leaf whose bits are set.
  struct Hit {
    std::int32_t first;     // position of the first sample in tree order, or its complement for a leaf
    std::uint32_t samples;  // how many; of a leaf: bit k is set iff sample first + k is in the ball
  };

  /// Appends to `hits` where the samples s with in_reach(center, squared_reach, s) are; returns their number.
  std::int64_t query(Vec3 center, double squared_reach, std::vector<Hit>& hits) const;

  /// Hands the index of every sample of `hit` to `found`, in no particular order.
  template <class Found>
  void for_each(const Hit& hit, Found found) const {
    if (hit.first >= 0) {
      const std::int32_t* id = ids_.data() + hit.first;
      for (const std::int32_t* const last = id + hit.samples; id != last; ++id) found(*id);
    } else {
      const std::int32_t* const ids = ids_.data() + ~hit.first;
      for (std::uint32_t rest = hit.samples; rest != 0; rest &= rest - 1) found(ids[std::countr_zero(rest)]);
    }
  }

  /// All samples, neighbours in space near each other: queries in this order find their nodes in the cache.
  const std::vector<std::int32_t>& order() const { return ids_; }

 private:
  struct Node {
    Vec3 lower, upper;         // bounding box of its samples
    std::int32_t first, last;  // its samples, positions in tree order
    std::int32_t right;        // right child, 0 for a leaf; the left child follows its parent
  };

  void build(std::span<const Vec3> samples, std::int32_t first, std::int32_t last);
  std::uint32_t in_leaf(const Node& leaf, Vec3 center, double squared_reach) const;

  std::vector<Node> nodes_;
  std::vector<std::int32_t> ids_;  // samples in tree order
  std::vector<double> x_, y_, z_;  // their coordinates, in tree order, padded to whole leaves
};

}  // namespace ballflow::geometry
