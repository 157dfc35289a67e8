// The medial axis of a union of balls (Amenta and Kolluri 2001; Kornberger 2010, 3.7).
//
// Notation: K is the dual complex of the union (see alpha_shape.hpp), R the union of its tetrahedra, S its
// simplices in no tetrahedron with their faces. W are the vertices of the boundary of the union, V(w) is
// the Voronoi cell of w in W, and V the union of the boundaries of the cells.
// The axis is S together with the intersection of R and V.
#pragma once

#include "base/monitor.hpp"
#include "types/medial_axis.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// What happens when the Betti numbers of the axis are not those of the union.
enum class AxisMismatch { warn, error };

struct MedialAxisOptions {
  AxisMismatch on_mismatch = AxisMismatch::warn;
  bool exact = false;  // do not try doubles first
};

/// The medial axis of the union whose dual complex is `complex`, homotopy equivalent to the union.
/// - Accepts every dual complex: empty, flat, without tetrahedra (the axis is then the complex itself), with
///   cavities, singular parts, several components, balls on a grid, tetrahedra as flat as doubles can say.
/// - Vertices are ball centres (radius: that of the ball) and Voronoi vertices of W (radius: the distance
///   to W). Voronoi vertices so close to each other that rounding alone may part them are one. Vertices,
///   edges and polygons are sorted by the balls that define them; the direction of a polygon is its sheet's.
/// - Balls in another order, mirrored at a coordinate plane or scaled by a power of two give exactly the same
///   axis, mirrored or scaled, but for the numbering and for places where sites coincide or are cospherical.
/// - Every polygon is plane and convex up to rounding; where one point of W belongs to several triangles of
///   the boundary of R (balls on a grid) it may be only plane.
/// - Its kind is wall where a side of it is an edge of the boundary of R, which then hangs on that side.
/// - W is computed in doubles, and what rounding may have parted is merged. All three Betti numbers of the
/// axis,
///   counted from its own polygons, edges and vertices, are compared with those of the union. Where they
///   differ (nearly flat tetrahedra, grids of balls that are not quite grids), the axis is made again without
///   a rounded decision: of balls in general position, grown by less than any feature (see grown_balls.hpp),
///   in as many bits as it takes. Polygons between points of W that are one but for rounding are then taken
///   away, and corners that are one joined, as far as the homotopy type stays; where the balls have ties, the
///   simplices of the axis in no tetrahedron are those of the grown balls. This takes some ten times as long.
/// - Numbers that differ all the same mean that `complex` is not the dual complex of its balls: a warning
/// that names
///   both, or an InputError.
/// - The complex must hold its invariants (see broken_invariant).
MedialAxis medial_axis(const SimplicialComplex& complex, const MedialAxisOptions& options, Monitor& monitor);
/// The same where the power diagram is at hand that the complex was read off. InputError when it is another
/// one.
MedialAxis medial_axis(const SimplicialComplex& complex, const PowerDiagram& diagram,
                       const MedialAxisOptions& options, Monitor& monitor);

}  // namespace ballflow::geometry
