// Balls to begin a search for an enclosing union with: few enlarged inner balls that cover the corners of
// patches.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "enclose/ball_cover.hpp"

namespace ballflow::geometry {

/// The largest balls that touch the surface in the middle of a patch from one side and hold no corner, for
/// `patches` of them. A ball is on the inner side when more of it is inside than not.
/// - `unit`: volume of a lattice cell.
std::vector<FloatBall> inner_balls(const BallCover& cover, float unit, std::size_t patches, Monitor& monitor);

/// At most `count` balls: inner balls that touch the surface in the middle of a patch, and corners of patches
/// as balls of radius 0, all grown by the least amount with which a greedy cover of the corners needs no more
/// than that (found by bisection). An inner ball is the largest one that touches the surface there from one
/// side and holds no corner; it is on the inner side when more of it is inside than not.
std::vector<FloatBall> start_balls(const BallCover& cover, float unit, std::size_t count, Monitor& monitor);

}  // namespace ballflow::geometry
