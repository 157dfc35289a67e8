// Which sums contribute, decided in slabs of space at a time.
#pragma once

#include <cstddef>
#include <vector>

#include "base/monitor.hpp"
#include "minkowski/power_triangulation.hpp"
#include "minkowski/sums.hpp"

namespace ballflow::geometry {

/// What a PowerTriangulation of all sums says, from triangulations of the sums that reach into each of
/// `slabs` slabs across the longest edge of the box of the centers, which are made side by side.
///
/// Proof. Whether a ball contributes, and whether its sphere is seen, is a matter of its cell within the
/// ball. A point of it in a slab has a power <= 0, so a ball to which its power is smaller has the point too:
/// it is in the triangulation of the slab. A ball in one slab is therefore decided there. For one that
/// reaches into several, the neighbors that it has in these cut its cell, within the ball, as all sums do;
/// one more triangulation has all such balls and their neighbors.
Contributing contributing_in_slabs(std::vector<Ball> sums, std::size_t slabs, Monitor& monitor);

/// As many slabs as threads are worth for so many sums.
std::size_t slabs_for(std::size_t sums);

}  // namespace ballflow::geometry
