// Balls mirrored at the origin.
#pragma once

#include "types/balls.hpp"

namespace ballflow::geometry {

/// The balls (-c, r), in the same order: -B of Minkowski sums. A point p lies in the union of obstacles +
/// (-B) exactly where B, moved by p, meets the obstacles. Exact; twice gives the balls again, but for the
/// samples that define them, which are left out. Accepts any balls, also none.
Balls mirrored(const Balls& balls);

}  // namespace ballflow::geometry
