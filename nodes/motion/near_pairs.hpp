// The pairs of balls of two sets that are next to each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "exact/separation.hpp"
#include "motion/ball_boxes.hpp"

namespace ballflow::geometry {

struct NearPair {
  BallPair balls;
  std::int32_t a = 0, b = 0;  // indices
};

/// By separation, exactly; then by a, then by b.
bool comes_before(const NearPair& p, const NearPair& q);

struct NearPairs {
  NearPair nearest;             // of all
  std::vector<NearPair> below;  // in order: the first ones of those with at most the threshold
};

/// `most`: of `below`.
NearPairs near_pairs(const BallBoxes& a, const BallBoxes& b, double threshold, std::size_t most,
                     Monitor& monitor);

/// For every ball of a, by its index, the first pair with a ball of b.
std::vector<NearPair> nearest_of_every(const BallBoxes& a, const BallBoxes& b, Monitor& monitor);

}  // namespace ballflow::geometry
