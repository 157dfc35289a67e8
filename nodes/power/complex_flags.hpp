// Which cells and facets of a regular triangulation belong to the dual complex of the union of balls.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "exact/ball_predicates.hpp"
#include "power/regular_cells.hpp"

namespace ballflow::geometry {

/// One entry per cell, as PowerDiagram::in_complex. A cell is in the complex when its balls meet, a facet
/// when a cell at it is, or when its balls meet and neither of the two balls opposite attaches it.
/// `predicates` are those of the balls that were triangulated.
std::vector<std::uint8_t> complex_flags(const CellTable& table, const BallPredicates& predicates,
                                        Monitor& monitor);

}  // namespace ballflow::geometry
