// The thesis' own way to keep the topology (Listing 3.2), word for word.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/balls.hpp"

namespace ballflow::geometry {

/// The balls that Listing 3.2 returns to `kept` (ascending ids of `balls`), ascending. All others are
/// inserted one after the other, by id; where one covers or makes a critical intersection it is returned, and
/// everything begins anew. An intersection (a circular arc or a corner of the boundary) is critical to a ball
/// that meets it when the centre of the ball is not in all balls that define the intersection.
/// - It sees intersections only: two balls inside a third one, or a ball that meets nothing, pass unnoticed.
///   Polar balls that cover a sample never lie so.
/// - One alpha-shape per insertion, and everything again per ball returned: for small sets.
/// - Where corners lie is rounded; which there are is exact.
std::vector<std::int32_t> listing_3_2(const Balls& balls, std::span<const std::int32_t> kept,
                                      Monitor& monitor);

}  // namespace ballflow::geometry
