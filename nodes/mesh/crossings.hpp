// Which segments in the plane cross.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/monitor.hpp"

namespace ballflow::geometry {

/// Pairs of segments that have a point in common which is not their common end, decided exactly. A segment is
/// named by the numbers of its ends in `points`. In the order of their
/// lower x. Ends when it has found `most`.
std::vector<std::pair<std::size_t, std::size_t>> crossings(
    std::span<const std::array<double, 2>> points,
    std::span<const std::pair<std::int32_t, std::int32_t>> segments, std::size_t most, Monitor& monitor);

}  // namespace ballflow::geometry
