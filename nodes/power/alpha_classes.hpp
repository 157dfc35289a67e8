// Which simplices of a regular triangulation belong to the weighted zero alpha-shape, and of which class they
// are. The notation is that of alpha_shape.hpp.
#pragma once

#include "base/monitor.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// The dual complex of the union of the balls whose power diagram is given, with classes of simplices and
/// Betti numbers. Decisions are exact.
SimplicialComplex alpha_classes(const PowerDiagram& diagram, Monitor& monitor);

}  // namespace ballflow::geometry
