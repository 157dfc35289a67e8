// Where the balls of a union would meet first if all their weights grew by the same amount (thesis, 3.5.2).
#pragma once

#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "power/regular_cells.hpp"

namespace ballflow::geometry {

/// The critical Gabriel points of weighted points (thesis, Definition 3.6), ascending, each once.
///
/// The Gabriel point of a face of the power diagram is where the face meets its dual simplex, an edge,
/// triangle or tetrahedron of the regular triangulation: the centre of the smallest orthogonal sphere of the
/// simplex, when it lies in the simplex and no other ball has a smaller power there. It is critical when it
/// is in no ball. `cells` are regular_cells(centers, weights).
///
/// Which points are critical is decided exactly for the doubles given (points on the border of their simplex
/// count); coordinates are exact but for one rounding, so they do not depend on the numbering of the balls.
std::vector<Vec3> critical_gabriel_points(std::span<const Vec3> centers, std::span<const double> weights,
                                          const RegularCells& cells, Monitor& monitor);

}  // namespace ballflow::geometry
