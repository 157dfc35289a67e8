// The balls that a finished set cover chose (thesis, 3.6).
#pragma once

#include "types/balls.hpp"
#include "types/cover_state.hpp"

namespace ballflow::geometry {

struct SelectBallsOptions {
  // Take what is chosen so far although samples remain to be covered.
  bool allow_unfinished = false;
};

/// The chosen balls of `cover`, ascending by index, with their defining samples.
/// - `balls` are those the covering matrix was made of: entry i is row i of the original instance.
/// - Throws InputError when the number of balls is another, when an index is out of range or chosen twice,
///   and when samples remain uncovered by the choice (unless allowed). Samples that no ball covers at all
///   do not count: the node that made the matrix reported them.
Balls select_balls(const CoverState& cover, const Balls& balls, const SelectBallsOptions& options);

}  // namespace ballflow::geometry
