// A triangle mesh of the boundary of a union of balls.
//
// exact: the dual complex of the union (Edelsbrunner 1995) names the corners of the boundary, where three
// spheres meet, and the arcs between them, where two do. Arcs are cut into chords once, for the patches on
// both sides; a patch, the part of one sphere, becomes the constrained Delaunay triangulation of its chords
// after stereographic projection. So the topology of the mesh is decided by exact predicates, and its
// vertices lie on the boundary of the union.
// grid: tetrahedra on the cells of a grid, of which the corners are inside or outside. The mesh is a closed
// manifold whatever is inside; it has the topology of the union where the cells are small enough.
// skin: not the boundary itself but the skin surface around the balls (Edelsbrunner 1999), for comparison.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/mesh_report.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class BallMeshMethod {
  exact,  // from the power diagram; balls that are not in general position grow a little; grid where that
          // fails
  grid,
  skin,  // smooth where spheres meet, and as far from them there as `shrink` asks for
};

struct BallMeshOptions {
  BallMeshMethod method = BallMeshMethod::exact;
  double error = 0.2;  // % of the longest edge of the bounding box of the balls: distance from the boundary
  std::int64_t most_faces = 20'000'000;  // a mesh of more is refused
  bool self_intersections = true;        // count them
  double keep_faces = 100;               // % of the triangles that simplification keeps; 100: all
  bool refine_notches = false;           // grid: until their bottoms are within the error, too
  double shrink = 0.5;                   // skin: towards 1 the union, the less the more it fills notches
};

struct BallMesh {
  TriangleMesh mesh;
  MeshReport report;
};

/// The boundary of the union of the closed balls: one surface for each component and for each cavity, faces
/// seen counter-clockwise from outside the solid.
/// - Accepts no ball (an empty mesh), nested, equal, tangent, disjoint balls, radius 0, and polar balls of
///   which many pass through one point.
/// - Balls in general position are meshed as they are. Where rounding would decide, every radius changes by
/// its
///   own amount, of 2^-30 or 2^-20 of the longest edge of the bounding box at most: it grows where that keeps
///   the Betti numbers, so balls that touch are joined, from outside or inside; else it shrinks where that
///   does; else it grows. report.growth says by how much, report.euler_meshed what the topology of the
///   changed balls is.
/// - The mesh depends on the set of balls, not on their order; that of mirrored balls is mirrored, and that
/// of
///   balls twice as large is twice as large, in general position. It does not depend on the number of
///   threads.
/// - A grid has vertices in the bottoms of notches, but may round sharp ones off: report.error_back says by
/// how
///   much. With refine_notches its cells become smaller until that is within the error, too, or two rounds
///   bring no progress.
/// - Simplification keeps closed manifolds what they are. The distances that are reported are measured again,
/// and may
///   be above the error.
/// - Patches of thin parts may cross each other: report.self_intersections. Triangles of a grid lie in
///   different tetrahedra; only in notches they may cross.
/// - A skin surface contains the balls and touches them. Its topology is that of balls larger by
/// 1 / sqrt(shrink):
///   report.euler_meshed. `error` is not what it is made to; report.error and error_back say how far it is
///   from the union. Every radius grows by its own amount of at most 2^-30 of the longest edge first, so that
///   nothing is a tie.
/// - Throws InputError for balls that break their invariants, a single point, an error that is not positive,
/// and
///   when there would be more faces than asked for.
BallMesh ball_mesh(const Balls& balls, const BallMeshOptions& options, Monitor& monitor);

}  // namespace ballflow::geometry
