// Samples of a closed surface that are dense where the shape asks for it, so that the union of the inner
// Delaunay balls has the topology of the solid.
#pragma once

#include <cstdint>
#include <optional>

#include "base/monitor.hpp"
#include "types/point_set.hpp"
#include "types/refinement.hpp"
#include "types/topology_table.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class RefineWhen : std::uint8_t {
  closed,  // surfaces that bound a solid; the points of others are returned as they are
  always,  // others are refused
  never,   // points are returned as they are
};

struct RefineOptions {
  RefineWhen when = RefineWhen::closed;
  // Lengths are % of the longest edge of the surface's bounding box.
  double delta = 0.5;             // no ball reaches farther to the wrong side of the surface
  double floor = 0.05;            // balls that reach less far are let be whatever lies behind
  double lowest_floor = 0.00002;  // where the topology asks for it the floor sinks, to this
  // A ball may reach into this fraction of the wall or slot behind the surface.
  double wall_fraction = 0.4;
  double sharp = 30;         // degrees: edges whose triangles turn by more are sampled from the start
  bool keep_points = false;  // the points that come in are samples too
  std::int64_t max_samples = 500'000;
};

struct Refined {
  PointSet points;
  // What bounds the inner cells: vertices are the points, triangles oriented. Closed; a manifold where the
  // report's `cells` are known, but for touching vertices else. Without triangles where nothing was refined.
  TriangleMesh surface;
  Refinement report;
};

/// Delaunay refinement by the balls of all Voronoi vertices, not by a local feature size, which is 0 at every
/// edge of a machine part. T denotes the cells with their centre inside the solid, by exact winding numbers.
///
/// 1. Start from corners and sharp edges, extreme points and some others.
/// 2. While a ball reaches farther than delta beyond the surface, or farther than the floor and wall_fraction
///    of the wall or slot that lies behind it: insert the surface point next to its centre, or where a wall
///    hides a sample from the centre that sample's mirror image on the wall. The deepest balls of a round
///    go first. The point next to a centre is farther from all samples than the ball was deep, a mirror image
///    at least lowest_floor, so this ends.
/// 3. While the boundary of T is no surface, or has other Betti numbers than the solid: lower the floor at
///    samples where that shows, add points where dual edges of their facets cross the surface, go to 2.
/// 4. Where that of the solid is known: while a sample of no inner ball is farther than 0.7 delta from
///    all of them, as the tip of a spike is, add rings of points around the line from the nearest ball to it,
///    as close as the spike is narrow, and go to 2. At most three times, and not at all where balls in narrow
///    ends do not hang together then.
/// 5. While the union of the balls has other Betti numbers than it should (caps of balls can meet outside of
///    T): add the points next to the balls that meet without a common sample, go to 2. At most four times.
///    Where nobody knows the topology of the solid 3 is done three times at most, and 5 only when T has one.
///
/// The union of all inner balls contains T: the power diagram of all Delaunay balls is the Delaunay
/// triangulation itself. So it has no holes inside however thin a wall is, as unions of polar balls have.
/// All of it is done with 0.0005 % as the lowest floor, and anew with lowest_floor where that did not
/// succeed: samples far closer together than a shape needs cost balls, and bring other balls together. There
/// is no proof that 3 and 5 succeed; the report says whether they have.
///
/// - `wanted`: Betti numbers of the solid, or nothing where they are unknown (self-intersections); then those
///   of T are what the union is compared with
/// - `points` are returned where nothing is refined; otherwise they matter with keep_points only
/// - the result does not depend on the number of threads
///
/// Throws InputError for options out of range, a mesh that breaks its invariants and, with
/// RefineWhen::always, one that is not closed, saying why.
Refined refine(const TriangleMesh& mesh, const PointSet& points, const std::optional<Betti>& wanted,
               const RefineOptions& options, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
