// Samples for what is sharper than the spacing of samples: tips of spikes.
#pragma once

#include <vector>

#include "search/surface_tree.hpp"
#include "types/balls.hpp"

namespace ballflow::geometry {

/// Points of a closed surface in rings around the line from the ball next to `end` to `end` itself, each ring
/// as far from the next as the surface is narrow there, at least `least`: balls through them have their
/// centres near that line. None where the end is at most `enough` away from the balls, or there are no balls;
/// the last ring is about `enough` / 2 away from the end. At most 64 rings of 8 points. Appends to `points`.
void add_rings(Vec3 end, const Balls& inner, double enough, double least, const SurfaceTree& surface,
               std::vector<SurfacePoint>& points);

}  // namespace ballflow::geometry
