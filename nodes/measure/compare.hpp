// The error of a set of balls: covering a sample says nothing about the surface between, or beyond.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/comparison.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct CompareOptions {
  // % of the longest bounding-box edge of the surface: no point of it, nor of the boundary of the union, is
  // farther from a sample. Above 0; time and memory grow with the inverse square.
  double spacing = 0.5;
  // Samples of the surface, and of the boundary of the union, at most: what more would need is refused.
  std::int64_t most_samples = 30'000'000;
};

/// Measures the distances between the surface and the boundary of the union of `balls`, and their volumes.
///
/// The surface is `mesh`, or, when it has no triangles, the points themselves: then nothing is claimed about
/// what lies between them.
///   - Samples of the surface are the centroids of equal parts of its triangles, each standing for its area.
///   - Samples of the boundary of the union are centroids of parts of the spheres, whose octahedra are split
///   until the spacing is reached and parts deep inside other balls are left out. A boundary point may have
///   its nearest sample just inside another ball; at_most counts these samples too, the value does not.
///   - at_least and at_most follow from the samples because distances change at most as much as positions.
///   - The distance of a sample inside the union is minus its depth in the ball in which it is deepest, where
///   a sample of the boundary is within 1/16 of the spacing of that; at_most allows for it.
///   - The volume of the union is that of union_measure. The volume of a closed mesh follows the orientation
///   of label_poles: neighbours are turned until they agree, and components outwards, but for cavities.
///
/// - Accepts any mesh, also open or not manifold, and any balls, also equal or nested ones and points.
/// - Refuses (InputError) no balls, no surface, options out of range, indices out of range, radii whose
/// squares overflow, and a spacing that needs more than most_samples.
/// - The result does not depend on the number of threads, and, but for the rounding of sums, not on the order
/// of balls, points and triangles.
Comparison compare(const Balls& balls, const PointSet& points, const TriangleMesh& mesh,
                   const CompareOptions& options = {}, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
