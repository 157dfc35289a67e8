// Other radii for given balls: so that they lie inside a solid, or that they contain it.
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class BallSide {
  inner,  // every ball lies inside the solid
  outer,  // the union contains the solid
};

struct OneSidedBallsOptions {
  BallSide side = BallSide::outer;
};

/// The same centres, with radii that make the union a bound of the solid from one side. How large they were
/// before does not matter, but that of balls of an open mesh.
///
/// inner: a radius is the distance of the centre from the surface, and centres that are not inside are left
///   out. A ball inside has no point outside then: it does not reach the surface. Radii are smaller than that
///   by 1e-9 of the longest edge of the box, and 2^-40 of the largest coordinate, against rounding.
/// outer: radii begin with these (0 around centres outside; around those of an open mesh the distance or the
///   old radius, whichever is less). Triangles are bisected until the ball that holds a part with least
///   growth grows by no more than a point of the part asks for, and 0.02 % of the longest edge or 5 % of what
///   the vertex asks for that asks for most; parts are
///   handed out to balls, those that need most growth first, and every ball grows as far as its parts ask
///   for. A part that lies in a ball by then needs none. No ball grows by more than the largest growth that
///   one part needs. A void that the union closes off gets a ball that touches the surface; these come last.
///   It is verify_enclosure that proves what came out.
/// - `solid`: a closed mesh whose inside and whose surface count in place of the mesh's, which is only what
///   has to be covered: for discs a prism, and in `mesh` the polygon itself (planar/polygon_meshes.hpp).
/// - Results have no defining samples. The same for any number of threads.
/// - Throws InputError for inputs that break their invariants, without triangles or balls; inner: for meshes
///   that are not closed, and where no centre is inside; outer: where voids are left after 64 rounds.
Balls one_sided_balls(const TriangleMesh& mesh, const Balls& balls, const OneSidedBallsOptions& options,
                      Monitor& monitor = no_monitor(), const TriangleMesh* solid = nullptr);

}  // namespace ballflow::geometry
