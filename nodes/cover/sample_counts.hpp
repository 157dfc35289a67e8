// How much of something balls put on the samples inside them, without a list of which ball covers which.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "search/sample_tree.hpp"
#include "types/balls.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {

/// For every sample the sum of `weights` (one for each ball, 0 costs nothing) of the balls that cover it, by
/// membership.hpp and the samples that define balls. `tree` is about the points. In parallel, in whole
/// numbers, so the order of additions does not matter. Time: a query for each ball of weight, however many
/// samples are in it.
std::vector<std::int64_t> sums_on_samples(const SampleTree& tree, const Balls& balls, const PointSet& points,
                                          std::span<const std::int32_t> weights,
                                          Monitor& monitor = no_monitor());

/// For every ball the sum of `values` (one for each sample) of the samples in it. `tree` is about the points.
std::vector<std::int64_t> sums_in_balls(const SampleTree& tree, const Balls& balls, const PointSet& points,
                                        std::span<const std::int32_t> values,
                                        Monitor& monitor = no_monitor());

/// Balls in an order in which neighbours in space follow each other.
std::vector<std::int32_t> near_balls(const Balls& balls);

/// `points` and `balls` as an instance that has the samples `ids` (ascending) alone, in that order.
struct SampleSubset {
  PointSet points;  // no normals
  Balls balls;      // all of them; those of their defining samples that are among `ids`
};
SampleSubset sample_subset(const Balls& balls, const PointSet& points, std::span<const std::int32_t> ids);

}  // namespace ballflow::geometry
