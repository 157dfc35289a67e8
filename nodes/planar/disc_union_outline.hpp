// The outline of a union of discs, as arcs.
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/disc_outline.hpp"

namespace ballflow::geometry {

/// Which discs have an arc, where it begins and ends, how arcs join, and which component they bound is read
/// off the dual complex of the union, whose every simplex is decided exactly for the discs given (their
/// squared radii are rounded once); only the coordinates of the ends are rounded.
///
/// - Three triangulations' worth of work: O(n log n) for most sets.
/// - Discs that touch in a point are joined there: the outline runs through the point twice. Where the
/// circles of three and
///   more discs pass through one point, nothing is exposed there but what has a length.
/// - Points (radius 0) have no outline; discs without an arc of their own are left out.
/// - Components are in the order of their first discs; rings begin with an arc of their first disc, holes are
/// in the
///   order of theirs.
///
/// Accepts any discs: none, equal, nested, on a line. Throws InputError for balls that break their
/// invariants, for a center with z other than 0, and for numbers that are not 0 and outside [1e-150, 1e150].
DiscOutline disc_union_outline(const Balls& discs, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
