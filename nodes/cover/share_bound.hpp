// The share bound (Kornberger 2010, Theorem 3.8).
#pragma once

#include "base/monitor.hpp"
#include "types/cover_state.hpp"

namespace ballflow::geometry {

/// Every sample that is left in the matrix has the share 1 / alpha, where alpha is the length of the longest
/// row that contains it. A cover of a connected component needs at least ceil(sum of its shares) balls; with
/// the essential and exact choices this is a lower bound on any cover of the instance.
///
/// Samples and lengths are those of the matrix as it is: call it after the reductions and before the first
/// greedy pick for the bound of the theorem, which takes one sum over all components and is never better.
/// The shares, rounded down, also go into the certificate if they prove more than what it holds. Chooses
/// nothing.
CoverState share_bound(const CoverState& state, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
