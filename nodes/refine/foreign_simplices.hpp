// Where balls of Delaunay cells meet although their cells do not.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/balls.hpp"

namespace ballflow::geometry {

/// Balls, ascending, of edges and triangles of the dual complex (tolerance polar) whose balls pass through no
/// common sample. Only there the union of the balls can differ from that of their cells.
/// Precondition: `samples` has the four samples of every ball's cell.
std::vector<std::int32_t> foreign_balls(const Balls& balls, const std::vector<std::array<Vec3, 4>>& samples,
                                        Monitor& monitor);

}  // namespace ballflow::geometry
