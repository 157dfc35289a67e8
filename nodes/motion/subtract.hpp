// Balls less other balls.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/balls.hpp"

namespace ballflow::geometry {

/// The balls of a with radii so small that none has a point inside a ball of b: a union that lies in that of
/// a less the inside of that of b.
///
/// - A radius becomes the distance of the center from the union of b, rounded downwards, where that is less.
/// Centers in
///   a ball of b, or on its sphere, go. Balls that meet no ball of b stay as they are.
/// - Accepts any balls, also none. In the order of a; defining samples are left out.
/// - Throws InputError for balls that break their invariants, and for coordinates or radii beyond 1e140.
Balls subtracted(const Balls& a, const Balls& b, Monitor& monitor);

}  // namespace ballflow::geometry
