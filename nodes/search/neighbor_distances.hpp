// How far the k-th nearest other point is: the spacing of a sample, point by point.
#pragma once

#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Of each point (n x 3, finite) the distance to the k-th nearest of the others, k from 1 to 64; infinite
/// where there are fewer. Points at one place are at distance 0.
std::vector<double> neighbor_distances(std::span<const Vec3> points, int k, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
