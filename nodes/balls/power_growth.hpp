// Growing balls along their power diagram, so that the topology of the union stays (thesis, 3.5.2).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "power/power_diagram.hpp"
#include "types/balls.hpp"
#include "types/growth.hpp"

namespace ballflow::geometry {

struct PowerGrowthOptions {
  // As in AlphaShape: polar balls as they come from a Voronoi diagram need `polar`, which every radius keeps.
  AlphaTolerance tolerance = AlphaTolerance::polar;
};

struct PowerGrowth {
  std::vector<double> radii;        // grown
  std::vector<double> limits;       // distance to the nearest critical Gabriel point (1 - 2^-41), or infinity
  std::vector<std::uint8_t> stops;  // GrowthStop
  std::array<std::int64_t, 3> betti_before{}, betti_after{};
  std::int64_t unions = 0;  // grown unions whose topology was looked at
};

/// Grows all weights (squared radii) by the same amount t, until every ball has its wished radius or has
/// ceased to grow at a critical Gabriel point of the union at the start. So ball b has radius
/// min(wished, limit), where the limit is the distance to the nearest of these points, of all balls and not
/// only of the neighbours of b. That is the step-by-step algorithm of the thesis, read as "every ball that
/// touches g ceases".
///
/// The thesis claims that balls that have ceased cannot cause new intersections; that is wrong. So the
/// inclusion of the union at the start in the grown one has to be an isomorphism in homology over Z/2, which
/// is decided exactly. Where it is none, balls that cease take their neighbours in the power diagram along,
/// whose weights then grow by no more: those within 1, 2, 3, 4, 6, 8, 16, 64 steps, in the end all balls.
/// Growth of all weights by one amount below the first critical Gabriel point is proved to keep the topology.
///
/// No radius shrinks. With tolerance `polar` every radius becomes at least sqrt(r^2 + delta).
/// Where `diagram` is given it is the power diagram of `balls` with the tolerance of the options.
/// Throws InputError as alpha_shape does, and for another diagram. Preconditions: wished radii are finite and
/// as many as balls.
PowerGrowth power_growth(const Balls& balls, std::span<const double> wished,
                         const PowerGrowthOptions& options, Monitor& monitor = no_monitor(),
                         const PowerDiagram* diagram = nullptr);

}  // namespace ballflow::geometry
