// Where the balls of a union would meet first if all their weights grew by the same amount (thesis, 3.5.2).
#pragma once

#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "types/power_diagram.hpp"

namespace ballflow::geometry {

/// The critical Gabriel points of the balls of a power diagram (thesis, Definition 3.6), ascending, each
/// once.
///
/// The Gabriel point of a face of the power diagram is where the face meets its dual simplex, an edge,
/// triangle or tetrahedron of the regular triangulation: the centre of the smallest orthogonal sphere of the
/// simplex, when it lies in the simplex and no other ball has a smaller power there. It is critical when it
/// is in no ball.
///
/// Which points are critical is decided exactly for the doubles given (points on the border of their simplex
/// count); coordinates are exact but for one rounding, so they do not depend on the numbering of the balls.
std::vector<Vec3> critical_gabriel_points(const PowerDiagram& diagram, Monitor& monitor);

}  // namespace ballflow::geometry
