// How dense a sample is against the features of its surface (thesis, Definition 3.2).
#pragma once

#include <functional>
#include <span>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// The least r for which every point x of a surface has a sample within r times its feature size.
struct SamplingRatio {
  double at_least = 0;  // attained at `at`
  double at_most = 0;   // infinite where that was not found out
  Vec3 at;              // a point of the surface
};

/// The supremum over the points of the mesh of their distance to the nearest sample divided by their feature
/// size, up to three per cent.
/// - `feature_size` must be 1-Lipschitz and not negative: any distance to a set is. With the true local
/// feature
///   size of a smooth surface, and a mesh that is that surface, the result is the r for which the sample is
///   an r-sample.
/// - Both quantities change at most as much as the point. That bounds the quotient over a whole triangle, and
///   triangles where the bound is too large are split in four until none is left.
/// - Search ends where at_least reaches 1, for nothing follows from such samples; at_most is then infinite.
/// So it
///   is when 20 million parts were not enough, or 4 million of one size. Where the feature size vanishes, as
///   at sharp edges, at_least counts at most 10^6.
/// - No triangles: both are 0. Throws InputError without samples.
/// - The same for any number of threads.
SamplingRatio sampling_ratio(std::span<const Vec3> samples, const TriangleMesh& mesh,
                             const std::function<double(Vec3)>& feature_size,
                             Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
