// A proof that balls contain everything inside a surface.
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/enclosure.hpp"
#include "types/power_diagram.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class OnOpen {
  error,   // InputError with the first triangle or void
  report,  // listed in the result
  expect,  // the same; of balls that are not meant to enclose
};

struct VerifyEnclosureOptions {
  OnOpen on_open = OnOpen::error;
};

/// Let M be the union of the triangles and U that of the balls. If M lies in U, and U leaves no void, then U
/// contains M and every point that M separates from infinity: a point outside U is joined to infinity outside
/// U, hence without meeting M. Nothing is asked of M: triangles may be doubled, open, crossing, of either
/// orientation. Where M is closed, a void outside of its solid (winding number 0) does no harm.
///
/// - M in U: a triangle lies in a ball when its corners do. One that lies in no single ball is bisected at
/// its
///   longest edge, and so are its parts, until each of them lies in one. Corners of parts are kept as integer
///   combinations of the corners of the triangle, and whether one is in a ball is decided exactly. A corner
///   in no ball ends the triangle. So do 60 bisections, or a million parts: there balls meet without overlap,
///   which a little larger radii cure.
/// - Voids are components of the complement of the dual complex (power/voids.hpp), decided exactly.
/// - The protrusion of a ball with radius r whose centre is at the distance d from M is at most r - d where
/// the
///   centre is inside the solid, else r + d; the largest of all balls, up to rounding. It is a bound: for
///   shells in each other it is too large.
///
/// Only triangles and balls are looked at, so that it also checks balls of other programs.
/// - `diagram`: the power diagram of the balls, with tolerance none, where it is at hand.
/// - gap_at_most: the distance from a ball is convex, so that the corners of a part bound it; parts are
///   bisected until the largest distance is known to 1 %, or 0.02 % of the longest edge of the box. What
///   rounding can add, 2^-44 of the largest coordinate, is added.
/// - `solid`: a closed mesh whose inside is what matters for voids and for the protrusion, where it is not
///   that of `mesh`: for discs a prism, and in `mesh` the polygon itself (planar/polygon_meshes.hpp).
/// - Throws InputError for inputs that break their invariants, no triangles but with on_open expect (then
///   nothing is proven), and with on_open error for what is not enclosed.
/// - The same for any number of threads.
Enclosure verify_enclosure(const TriangleMesh& mesh, const Balls& balls,
                           const VerifyEnclosureOptions& options, Monitor& monitor = no_monitor(),
                           const PowerDiagram* diagram = nullptr, const TriangleMesh* solid = nullptr);

}  // namespace ballflow::geometry
