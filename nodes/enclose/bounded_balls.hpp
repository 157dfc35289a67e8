// k balls that stay inside a solid, or stand out by no more than a given distance, and cover as much as they
// can.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/enclosure_fit.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class BallGoal {
  volume,   // little of the solid's volume is in no ball
  surface,  // little of its surface is
};

struct BoundedBallsOptions {
  std::int64_t balls = 20;
  double within = 0;  // model units: no point of a ball is farther from the solid
  BallGoal goal = BallGoal::volume;
  std::int64_t rounds = 3;  // of the local search
  std::int64_t seed = 1;
};

struct BoundedBalls {
  Balls balls;
  EnclosureFit fit;
};

/// A ball whose centre is inside, d away from the surface, and whose radius is d + within, has no point
/// farther than `within` from the solid. Centres are those of largest inner balls, chosen greedily by what
/// they cover, then moved and exchanged for others while that covers more. Radii are smaller than that by
/// 1e-9 of the model, so that rounding makes none too large.
///
/// Fewer balls are returned where more cover nothing.
/// - Runs in one thread; the same bytes on every machine.
/// - Throws InputError for inputs that break their invariants, meshes that are not closed, and negative
/// numbers.
BoundedBalls bounded_balls(const TriangleMesh& mesh, const BoundedBallsOptions& options,
                           Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
