// What the sums in space and in the plane have in common: which inputs are usable, lists of sums that fit
// into memory, the order of results.
#pragma once

#include <cstdint>
#include <vector>

#include "base/memory.hpp"
#include "base/monitor.hpp"
#include "minkowski/sums.hpp"

namespace ballflow::geometry {

/// Refuses balls that break their invariants, and numbers that are not 0 and outside [1e-150, 1e150].
void require_usable(const Balls& balls, const char* name);

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

/// The sums, ascending by center.
Balls canonical(std::vector<Ball> sums);

}  // namespace ballflow::geometry
