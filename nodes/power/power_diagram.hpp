// The power diagram of balls: their regular triangulation, and what of it is in the dual complex of the
// union.
#pragma once

#include <vector>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// What is added to every squared radius before anything is decided.
enum class AlphaTolerance {
  none,   // nothing: balls are what their radii say
  polar,  // 2^-36 L^2, L the longest edge of the bounding box of the balls
};

struct PowerDiagramOptions {
  // Polar balls as they come from a Voronoi diagram meet in the samples they pass through, four and more in
  // one point, so that rounding decides which of them touch. `polar` lets all of them overlap by far more
  // than rounding and far less than a feature. Enlarged balls need `none`.
  AlphaTolerance tolerance = AlphaTolerance::none;
};

/// The delta of the notation of alpha_shape.hpp.
double alpha_delta(const Balls& balls, AlphaTolerance tolerance);

/// The weights of the balls in their power diagram: squared radii and the tolerance.
/// Throws InputError for balls that break their invariants or have a radius whose square overflows, and for
/// 2^31 balls or more.
std::vector<double> ball_weights(const Balls& balls, AlphaTolerance tolerance);

/// The regular triangulation of the balls, with flags of the cells and facets in the dual complex.
/// - Accepts and refuses what alpha_shape does.
/// - Decisions are exact for the doubles `centers` and `weights` of the result, ties are broken symbolically:
/// the
///   result depends on the balls and their numbers alone.
PowerDiagram power_diagram(const Balls& balls, const PowerDiagramOptions& options, Monitor& monitor);

/// Throws InputError where the diagram is not that of these balls with this tolerance.
void check_diagram_of(const PowerDiagram& diagram, const Balls& balls,
                      AlphaTolerance tolerance = AlphaTolerance::none);
/// Throws InputError where the complex is about other balls or weights.
void check_diagram_of(const PowerDiagram& diagram, const SimplicialComplex& complex);

}  // namespace ballflow::geometry
