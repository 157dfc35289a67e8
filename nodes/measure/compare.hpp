// The error of a set of balls: covering a sample says nothing about the surface between, or beyond.
#pragma once

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
///   - The volume of the union is bounded by cubes of an octree inside one ball, and outside all balls; cubes
///   of edge `spacing` on the boundary count as much as the distance to it suggests.
///
/// - Accepts any mesh, also open or not manifold, and any balls, also equal or nested ones and points.
/// - Refuses (InputError) no balls, no surface, options out of range, indices out of range, and a spacing
/// that
///   needs more than 30 million samples or cubes.
/// - The result does not depend on the number of threads.
Comparison compare(const Balls& balls, const PointSet& points, const TriangleMesh& mesh,
                   const CompareOptions& options = {}, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
