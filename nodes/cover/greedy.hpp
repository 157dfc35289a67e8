// Greedy set covering (Kornberger 2010, 3.6.3 and Listing 3.1).
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/cover_state.hpp"

namespace ballflow::geometry {

enum class GreedyMode : std::uint8_t {
  until_covered,      // the row that covers most of what is left, again and again (Listing 3.1)
  one_per_component,  // one longest row of every connected component, once: the step of the hybrid algorithm
  all,                // every row: nothing is pruned
};

struct GreedyOptions {
  GreedyMode mode = GreedyMode::until_covered;
  bool remove_redundant = false;  // until_covered: drop picks whose samples other picks cover, shortest first
};

/// Chooses rows of the residual matrix. Ties go to the ball of lowest index.
///
/// - Picks are marked Choice::greedy, or Choice::all in mode all.
/// - The lower bound is raised first, by what the residual proves component by component, and again
///   after the picks (Lemma 3.7; see raise_lower_bound).
/// - Redundant picks are looked for among the picks of this call only.
CoverState greedy(const CoverState& state, const GreedyOptions& options = {},
                  Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
