// Balls whose squares are doubles, for algorithms that decide with weights r^2.
#pragma once

#include "types/balls.hpp"

namespace ballflow::geometry {

/// Throws InputError for balls that break their invariants, and for coordinates and radii that are not 0 and
/// outside [1e-150, 1e150]; `name` is that of the input: "a".
void require_usable(const Balls& balls, const char* name);

/// The same for discs, which have z = 0; `instead` says what takes other balls.
void require_discs(const Balls& discs, const char* name, const char* instead);

}  // namespace ballflow::geometry
