// Betti numbers of a medial axis from its own cells.
#pragma once

#include "base/monitor.hpp"
#include "types/medial_axis.hpp"
#include "types/topology_table.hpp"

namespace ballflow::geometry {

/// Components, and cycles of polygons over Z/2, from the polygons, edges and vertices of the axis and from
/// nothing else; the number of tunnels follows from the Euler characteristic.
Betti axis_betti(const MedialAxis& axis, Monitor& monitor);

}  // namespace ballflow::geometry
