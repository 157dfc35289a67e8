// What a look at a model shows: its surface, and where it is thin, open or crosses itself.
#pragma once

#include <vector>

#include "inspect/model_report.hpp"
#include "show/scene.hpp"

namespace ballflow::inspect {

/// Triangles coloured by the width of the wall behind them (half of them, and those without one, as the
/// widest of the others), open edges as lines, and balls at the thinnest wall, the narrowest slot, the first
/// crossings and stray points.
std::vector<show::Layer> layers_of(const ModelReport& report,
                                   geometry::Monitor& monitor = geometry::no_monitor());

}  // namespace ballflow::inspect
