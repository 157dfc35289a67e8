// The order in which points are inserted into a triangulation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// The numbers of the points (n x 3, finite, fewer than 2^31) in an order in which those that follow each
/// other are close, so that each is found from the one before: some random ones first, then more and more of
/// them, each lot along a Hilbert curve (CGAL's spatial sort). Triangulations do not depend on the order,
/// only their speed does.
std::vector<std::int32_t> spatial_order(std::span<const Vec3> points);

}  // namespace ballflow::geometry
