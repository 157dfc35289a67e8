// Finds balls that lie inside another one, without comparing all pairs of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "minkowski/sums.hpp"

namespace ballflow::geometry {

/// A grid that remembers for every voxel one of the balls offered: that with the largest depth r - |c - v| of
/// the center v of the voxel, as far as two sweeps over the grid find it. A ball is inside another when the
/// depth of its center is at least its radius, and depths change at most as much as places; so a ball that is
/// inside another is probably inside that of its voxel, or of a neighbour.
class ContainmentFilter {
 public:
  /// `box` holds the centers; at most `voxels` voxels.
  ContainmentFilter(const Box& box, double voxels);

  void offer(const Ball& ball);
  /// As if what `later`, a filter of the same box and voxels, was offered were offered to this one now.
  void merge(const ContainmentFilter& later);
  void spread(Monitor& monitor);

  /// The ball is strictly inside one that was offered, whatever was rounded here.
  bool contains(const Ball& ball) const;

 private:
  using Index = std::array<std::size_t, 3>;
  Index index_of(Vec3 p) const;
  Vec3 center_of(const Index& index) const;

  struct Entry {
    Ball ball;
    double depth;
    void improve(const Ball& other, Vec3 voxel_center);
    void improve(const Entry& other) {
      if (other.depth > depth) *this = other;
    }
  };
  Vec3 lower_;
  double edge_ = 1, inverse_ = 1;
  Index size_{1, 1, 1}, stride_{};
  std::vector<Entry> entries_;
};

/// How many voxels are worth their time for so many pairs.
inline double filter_voxels(double pairs) { return std::clamp(pairs / 16, 1.0, 0x1p18); }

}  // namespace ballflow::geometry
