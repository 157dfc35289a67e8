// Samples opposite to samples, on thin walls.
#pragma once

#include <vector>

#include "refine/refined_triangulation.hpp"

namespace ballflow::geometry {

/// Where a wall stands between a sample and the centre: the point of the wall that is opposite to the sample.
/// Spacing alone separates the sides of a thin wall only where samples are as close as the wall is thin;
/// mirrored samples do so at once.
/// - `least`: images are at least so far from each other and from all samples
std::vector<SurfacePoint> mirror_images(const RefinedTriangulation& triangulation,
                                        RefinedTriangulation::Cell cell, double least);

}  // namespace ballflow::geometry
