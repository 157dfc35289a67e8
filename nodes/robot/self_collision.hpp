// Which links of a robot need not be tested against each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/robot_spheres.hpp"

namespace ballflow::geometry {

struct SelfCollisionOptions {
  std::int64_t poses = 2000;  // that are tried; 0: none is looked for
};

struct UntestedPairs {
  std::vector<std::array<std::int32_t, 2>> links;  // the first before the second; ascending
  std::vector<std::uint8_t> reasons;               // PairReason
};

/// Pairs of links with balls that need no test against each other:
/// - adjacent: a joint joins them, also over links without balls that hang on by fixed joints;
/// - in_default: their balls meet where every joint is at 0, or at the limit nearest to it;
/// - always: their balls meet in every pose that was tried, never: in none of them.
///
/// Poses are sampled, not proven: every moving joint has an equally distributed value between its limits, or
/// all around, from random numbers of a fixed beginning; joints that follow others follow, floating and
/// planar ones stay. A pair called "never" may meet in a pose that was not tried.
///
/// The same for any number of threads.
UntestedPairs untested_pairs(const RobotSpheres& spheres, const SelfCollisionOptions& options,
                             Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
