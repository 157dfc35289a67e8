// A smallest part of a set of balls that has the same union: none of what is left can go.
//
// Notation: the power of a point x to a ball (c, r) is |x - c|^2 - r * r, with the square rounded; balls are
// the sets of points of power <= 0. The cell of a ball is where the power to it is strictly smaller than to
// all others, and a ball contributes when its cell has a point of it (contribution.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/balls.hpp"

namespace ballflow::geometry {

/// What the balls are: in the plane a ball with z = 0 is a disc, which others may cover although they leave
/// something of the ball in space.
enum class UnionOf { balls, discs };

struct MinimalUnionOptions {
  UnionOf of = UnionOf::balls;
};

struct MinimalUnion {
  std::vector<std::int32_t> kept;  // ascending indices
  std::int64_t contributing = 0;   // balls that contribute among all others
  // Of these, with a piece of their sphere (of discs: circle; radius 0: their point) on the boundary of the
  // union. They are all kept.
  std::int64_t touching_boundary = 0;
};

/// An inclusion-minimal part of the balls with the same union: no ball of it is covered by the others of it.
/// It need not be one of the fewest balls.
/// - Balls that do not contribute go at once; of equal balls the one of lowest index stays. The others are
///   asked one by one, each of which is covered by those that are still there goes: by ascending radius, of
///   equal ones by ascending center (x, then y, then z). So the result is a function of the set of balls.
/// - Exact for the doubles given: a ball is covered by the others if and only if its cell is bounded, all
///   vertices of its cell are in the union, and so are all vertices that the cells of the others have in its
///   own when it is gone, each of which is the orthocenter of a simplex of their regular triangulation.
///   Proof: the cell is then in the ball, and within a cell of another ball the power to that is convex, so
///   it is largest at a vertex. Where one of the vertices is outside the union there is a point of the ball
///   and its cell with positive power to all others.
/// - Accepts any balls: none, one, equal, concentric and tangent ones, centers on a plane or a line, radius
/// 0.
/// - Throws InputError for balls that break their invariants, for discs with z other than 0, and for
///   coordinates and radii that are not 0 and outside [1e-150, 1e150].
MinimalUnion minimal_union(const Balls& balls, const MinimalUnionOptions& options = {},
                           Monitor& monitor = no_monitor());

/// The same of balls that are known to contribute, all of them.
MinimalUnion minimal_of_contributing(const Balls& balls, const MinimalUnionOptions& options = {},
                                     Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
