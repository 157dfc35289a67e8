#include "power/alpha_shape.hpp"

#include "power/alpha_classes.hpp"

namespace ballflow::geometry {

SimplicialComplex alpha_shape(const Balls& balls, const AlphaShapeOptions& options, Monitor& monitor) {
  PartMonitor triangulating(monitor, 0, 0.7), classifying(monitor, 0.7, 1);
  return alpha_shape(power_diagram(balls, options, triangulating), classifying);
}

SimplicialComplex alpha_shape(const PowerDiagram& diagram, Monitor& monitor) {
  SimplicialComplex complex = alpha_classes(diagram, monitor);
  monitor.step(1);
  return complex;
}

}  // namespace ballflow::geometry
