// Betti numbers of unions of balls, counted without listing a simplex.
#pragma once

#include <array>
#include <cstdint>

#include "base/monitor.hpp"
#include "power/power_diagram.hpp"
#include "types/balls.hpp"
#include "types/power_diagram.hpp"

namespace ballflow::geometry {

/// Components, tunnels and cavities of the union of the balls: those of alpha_shape(), without its lists.
/// Components are those of the edges of the dual complex, cavities by Alexander duality components of cells
/// outside of it, and tunnels follow from the Euler characteristic.
std::array<std::int64_t, 3> union_betti(const PowerDiagram& diagram, Monitor& monitor);
/// The same for balls whose power diagram nobody wants: it is not put in order. Accepts and refuses what
/// alpha_shape does.
std::array<std::int64_t, 3> union_betti(const Balls& balls, AlphaTolerance tolerance, Monitor& monitor);

}  // namespace ballflow::geometry
