// A way between two points around a union of balls.
#pragma once

#include <string>
#include <string_view>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/minkowski_report.hpp"
#include "types/power_diagram.hpp"
#include "types/way.hpp"

namespace ballflow::geometry {

struct FindWayOptions {
  std::string start = "0 0 0";  // "x y z", model units
  std::string goal = "0 0 0";
};

/// "1 2.5 -3" or with commas as a point. Throws InputError, naming the parameter `name`, for anything else.
Vec3 parse_point(std::string_view text, const char* name);

/// Whether two points can be joined without meeting the union of the balls, and if so by what polyline.
///
/// - The components of the complement of the union are those of the complement of its dual complex K, as the
/// power
///   diagram has them (Voids). A point outside of the union is outside of K, which lies in the union; the
///   cell of the regular triangulation that it lies in, found by exact predicates, tells its component.
/// - Where the power diagram has a vertex whose cell is not in K the power to all balls is positive there,
/// and so it is
///   on all of an edge of it whose facet is not in K: both are outside of the union. A way leaves start and
///   goal in directions in which the power to the balls grows, until it is on the edges, and takes a shortest
///   way along them; in the unbounded component also around everything. Then corners are cut off where that
///   comes no nearer to the balls than the way comes somewhere. Every segment is checked exactly in the end.
/// - Start and goal may be anywhere. On a sphere counts as inside. Points are moved, nothing turns.
/// - Decisions are exact for the doubles `centers` and `weights` of the diagram. The weights are the squares
/// of
///   radii as they are rounded: a way that is narrower than that may be wrongly open or closed.
/// - `report` is that of the Minkowski sum that the balls are, or null: what it proves decides what a way
/// proves.
/// - Throws InputError for no balls, for a diagram of other balls or with a tolerance, and for points that
/// are not
///   finite or beyond 1e140.
Way find_way(const Balls& balls, const PowerDiagram& diagram, Vec3 start, Vec3 goal, Monitor& monitor,
             const MinkowskiReport* report = nullptr);

}  // namespace ballflow::geometry
