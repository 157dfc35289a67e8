// A kd-tree of samples for ball queries whose answers are those of the membership predicate, bit for bit.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.hpp"
#include "search/box_tree.hpp"

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
      const std::int32_t* id = order().data() + hit.first;
      for (const std::int32_t* const last = id + hit.samples; id != last; ++id) found(*id);
    } else {
      const std::int32_t* const ids = order().data() + ~hit.first;
      for (std::uint32_t rest = hit.samples; rest != 0; rest &= rest - 1) found(ids[std::countr_zero(rest)]);
    }
  }

  /// All samples, neighbours in space near each other: queries in this order find their nodes in the cache.
  const std::vector<std::int32_t>& order() const { return tree_.order(); }

 private:
  std::uint32_t in_leaf(const BoxTree::Node& leaf, Vec3 center, double squared_reach) const;

  BoxTree tree_;
  std::vector<double> x_, y_, z_;  // coordinates of the samples in tree order, padded to whole leaves
};

}  // namespace ballflow::geometry
