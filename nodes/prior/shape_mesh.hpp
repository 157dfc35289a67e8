// Instances of a model of a shape as meshes: with the triangles of the template's own surface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/point_set.hpp"
#include "types/shape_prior.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// The surface of the template where the mean of the model has it: its vertices go where the smooth map goes
/// that takes the template's surface points to those of the mean. The same triangles, and so the same
/// topology.
///
/// - `surface`: any mesh, in the coordinates of the template; closed and oriented where a solid is wanted
/// - `points`: those that the template was matched with, m as in the model, same coordinates
/// - warns where the map turns triangles inside out
///
/// Throws InputError for other numbers of points, for a model without any, and where the points are in one
/// plane. Time O(vertices x points), of at most 1500 points.
TriangleMesh mesh_of_mean(const ShapePrior& prior, const TriangleMesh& surface, const PointSet& points,
                          Monitor& monitor = no_monitor());

/// What holds of the mesh of an instance; model units.
struct ShapeMeshCheck {
  std::int64_t folded = 0;  // triangles with a corner where the map from the mean turns space inside out
  std::int64_t intersections = 0;  // pairs of triangles that cross, and triangles without area: at least so
                                   // many where there are 100 000
  std::int64_t of_mean = 0;        // those that the mesh of the mean has already
  bool closed = false;
  double volume = 0;         // inside, where it is closed; negative where it is inside out
  double mean_distance = 0;  // of the vertices from the surface of the union of the balls
  double largest_distance = 0;
};

struct ShapeMesh {
  TriangleMesh mesh;
  ShapeMeshCheck check;
};

/// The mesh of the instance with these scores: that of the mean, drawn along the smooth map from the mean's
/// surface points to those of the instance, and then, if there is one, by `pose` (3 x 4 by rows).
///
/// - `balls`: of the instance in the same pose, for the distances; at a place inside of several balls |x - c|
///   - r of the nearest sphere counts, which is at most the distance
/// - warns in words where triangles are turned inside out, or cross where those of the mean do not; and where
///   the model has no mesh, which makes an empty one
///
/// Throws InputError for more scores than modes.
ShapeMesh shape_mesh(const ShapePrior& prior, std::span<const double> scores,
                     const std::optional<std::array<double, 12>>& pose, const Balls& balls,
                     Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
