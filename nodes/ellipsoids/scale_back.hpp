// Balls of a stretched object as ellipsoids of the object, grown by a length (Kornberger 2010, 6.4).
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/bisection.hpp"
#include "types/ellipsoids.hpp"
#include "types/scaling.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class EllipsoidGrowth : std::uint8_t {
  axes,    // every half-axis by the same length, in the space of the object
  scaled,  // the radius of the ball, by that length, before it is scaled back: Kornberger's way
};

struct ScaleBackOptions {
  EllipsoidGrowth growth = EllipsoidGrowth::axes;
  double epsilon = 0.3;  // % of the longest edge of the object's box along the coordinates; at least 0
  double max_error = 0;  // in its place, model units of the object; 0: epsilon counts
};

struct ScaledBack {
  Ellipsoids ellipsoids;       // of the balls, in their order; without balls of radius 0 where nothing grows
  double growth = 0;           // model units of the object
  std::int64_t shortened = 0;  // balls whose radius was the distance to the surface instead
  double shortened_by = 0;     // the most, in units of the stretched space
};

/// Ball (c, r) becomes the ellipsoid whose center is c scaled back and whose half-axes are r / f_i, f the
/// factors of the scaling, and these grow by e:
///   axes:   r / f_i + e. The support function of an ellipsoid is |A u|, so that of the grown one,
///           |A u + e u| <= |A u| + e, is at most that of the points within e of it.
///   scaled: (r + e) / f_i. Factors are at least 1, so it lies in the other one; but unions are images of
///           unions of balls, so whatever is known of the topology of these holds.
/// In both, no point of an ellipsoid is farther than e from the ellipsoid of the ball as it was. A linear map
/// keeps "inside", so: where the ball lies in the stretched solid, no point of its ellipsoid is farther than
/// e from the solid. For that `mesh`, the surface of the stretched solid, shortens the radius of a ball to
/// the distance of its center from the surface (balls of Voronoi vertices stand out a little); the centers
/// have to be inside. All of this up to rounding, about 2^-48 of the size of the object.
///
/// `search` overrides the length, as a search for epsilon (see Bisect).
/// Throws InputError for options out of range, inputs that break their invariants, and radii that leave the
/// range of doubles.
ScaledBack scale_back(const Balls& balls, const Scaling& scaling, const TriangleMesh& mesh,
                      const ScaleBackOptions& options = {}, const Bisection* search = nullptr,
                      Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
