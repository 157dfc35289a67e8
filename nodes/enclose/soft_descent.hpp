// All balls at once, downhill: the volume they waste, smoothed, and a price for what they leave uncovered.
#pragma once

#include <vector>

#include "enclose/ball_cover.hpp"

namespace ballflow::geometry {

struct SoftDescentOptions {
  int steps = 250;
  float width = 1.5F;     // of the smoothed sphere, in spacings of the lattice
  float first_price = 8;  // of a uncovered area, in multiples of the area that balls show outside
  float last_price = 60;
  float first_rate = 0.03F, last_rate = 0.003F;  // how far a step goes, in mean radii
};

/// Moves and resizes the balls by gradients [Kingma and Ba 2015, Adam]. A point in several balls pulls the
/// one that it is deepest in. The result covers nearly all corners of the patches, not all.
/// - `areas`: what each vertex of the cover stands for; `unit`: volume of a lattice cell.
std::vector<FloatBall> soft_descent(const BallCover& cover, const std::vector<float>& areas, float unit,
                                    std::vector<FloatBall> balls, const SoftDescentOptions& options,
                                    Monitor& monitor);

}  // namespace ballflow::geometry
