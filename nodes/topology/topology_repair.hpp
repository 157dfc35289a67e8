// Balls returned after pruning, so that the union has its old topology again (thesis, 3.6.5).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/cover_state.hpp"
#include "types/power_diagram.hpp"
#include "types/topology_check.hpp"

namespace ballflow::geometry {

enum class RepairMethod {
  localised,  // few balls near what is wrong
  literal,    // Listing 3.2 of the thesis; for small sets
};

struct TopologyRepairOptions {
  RepairMethod method = RepairMethod::localised;
  // Where more classes than that are lost or extra, only components are mended: of a surface that crosses
  // itself all over, the balls have tunnels that nobody wants to keep, and minutes go by. At least 0.
  std::int64_t most_defects = 2000;
};

struct TopologyRepair {
  std::vector<std::int32_t> returned;  // ascending ids
  TopologyCheck check;
};

/// `cover` with the balls that were returned chosen as well (Choice::returned), ascending, after the others.
CoverState with_returned(const CoverState& cover, std::span<const std::int32_t> returned);

/// Balls of `balls` (U+) to be returned to those with the ids `kept` (U*), so that the inclusion of the union
/// in U+ induces isomorphisms of homology over Z/2: compared in the end, whatever the method did (see
/// inclusion_homology.hpp). Nothing is returned when it does so already.
///
/// `localised` looks at what differs. Parts of a component are joined, and lost loops closed, by shortest
/// paths of balls of U+. Where U* has a loop or a void that U+ has filled, or one void instead of two, balls
/// around the place are returned, twice as many when the place is met again. Then returned
/// balls that are superfluous are taken out again, one by one (superfluous_balls.hpp). In the worst case
/// every ball comes back, which the check says. With more than most_defects only components are joined and
/// begun, and the check says that the inclusion is no isomorphism.
/// - Radii are taken as they are: use enlarged balls.
/// - `kept` ascends. Throws InputError for ids out of order or out of range, for balls that break their
///   invariants, and for more than 2000 balls with method literal.
/// - Where `diagram` is given it is the power diagram of `balls`, with tolerance none; InputError when it is
/// not.
/// - The same for any number of threads.
TopologyRepair repair_topology(const Balls& balls, std::span<const std::int32_t> kept,
                               const TopologyRepairOptions& options, Monitor& monitor,
                               const PowerDiagram* diagram = nullptr);

/// The same for the balls that a cover chose. What was wrong is a warning in words. Throws InputError for a
/// cover about another number of balls.
TopologyRepair repair_topology(const Balls& balls, const CoverState& cover,
                               const TopologyRepairOptions& options, Monitor& monitor,
                               const PowerDiagram* diagram = nullptr);

}  // namespace ballflow::geometry
