// What the sums in space and in the plane have in common: lists of sums that fit into memory, the order of
// results, and what is kept of them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/memory.hpp"
#include "base/monitor.hpp"
#include "minkowski/minkowski_sum.hpp"
#include "minkowski/power_triangulation.hpp"
#include "minkowski/sums.hpp"
#include "power/minimal_union.hpp"

namespace ballflow::geometry {

/// Refuses `sums`, or `more` than that, which would have to be triangulated at so many bytes each, when the
/// memory or 32-bit indices do not hold them.
void require_memory(std::int64_t sums, double bytes_per_sum, const MemoryLimit& memory, bool more = false);

/// All sums; progress goes from 0 to 0.05.
std::vector<Ball> all_sums(const Sums& sums, double bytes_per_sum, Monitor& monitor);

/// All sums but some that lie strictly inside another; progress goes from 0 to 0.15. At a point of such a
/// ball
/// the power to the one around it is smaller, so it does not contribute; and nothing else changes: a ball
/// contributes or not whether or not balls that do not contribute are there, because below 0 the least power
/// is that to a ball that does.
std::vector<Ball> filtered_sums(const Sums& sums, double bytes_per_sum, Monitor& monitor);

/// The balls of a result, ascending by center, of what contributes; fills in what the report says of them.
Balls keep(Contributing found, MinkowskiKeep what, UnionOf of, MinkowskiReport& report, Monitor& monitor);

}  // namespace ballflow::geometry
