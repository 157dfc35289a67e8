// The error of a set of ellipsoids, as Compare measures that of balls.
#pragma once

#include "measure/compare.hpp"
#include "types/ellipsoids.hpp"

namespace ballflow::geometry {

/// What compare() says, for ellipsoids: distances between the surface and the boundary of the union, with
/// bounds that hold between the samples, coverage, volumes. What differs:
///   - The distance of a point to an ellipsoid is the root of an equation (Ellipsoid::signed_distance), right
///   to
///     2^-42 of its longest half-axis.
///   - The union's volume is that along 512 x 512 lines (ellipsoid_union.hpp), not by formulas: right to
///     about 1e-4 of it.
///   - protrusion: the least t for which, for every ellipsoid with half-axes a, the one with half-axes
///     max(a - t, 0) and the same axes does not meet the surface; at most 1 % or 2^-20 of the longest edge
///     above it, never below. The ellipsoid lies within t of the smaller one (support functions: |A u| <= |A'
///     u| + t), which lies in the solid where its center does: so no ellipsoid with its center inside reaches
///     farther than t beyond the surface. For balls that is r - d(c, M). It is proven from triangles and
///     ellipsoids alone, in the object's own space.
///   - The union has no distance of a sample in its inside to the boundary but minus its depth in one
///     ellipsoid, as for balls.
///
/// Accepts any mesh and any ellipsoids; refuses what compare() refuses.
Comparison compare_ellipsoids(const Ellipsoids& ellipsoids, const PointSet& points, const TriangleMesh& mesh,
                              const CompareOptions& options = {}, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
