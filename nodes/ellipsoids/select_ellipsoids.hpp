// The ellipsoids that a cover chose.
#pragma once

#include "types/cover_state.hpp"
#include "types/ellipsoids.hpp"

namespace ballflow::geometry {

/// The chosen ellipsoids of a finished cover, ascending by index.
/// Throws InputError for a cover of another number of ellipsoids, one that leaves samples to be covered, and
/// a damaged one: indices out of range, or twice.
Ellipsoids select_ellipsoids(const CoverState& cover, const Ellipsoids& ellipsoids);

}  // namespace ballflow::geometry
