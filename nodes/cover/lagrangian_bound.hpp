// A lower bound on any cover by Lagrangian relaxation, with a certificate of integers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "cover/components.hpp"
#include "types/cover_state.hpp"

namespace ballflow::geometry {

struct LagrangianBoundOptions {
  std::int64_t iterations = 1500;  // at most, for each component; 0 only spreads prices greedily
  double momentum = 0.95;       // share of the previous direction in the next one; 0 is the plain subgradient
  std::int64_t patience = 30;   // iterations without a better bound before the step gets shorter
  double shrink = 0.7;          // factor of the step then
  double first_step = 1;        // factor of the first step; small ones keep near multipliers that are good
  bool return_to_best = false;  // after twice the patience without a better bound: from the best multipliers
};

/// The relaxation of one component.
struct Relaxation {
  std::vector<float> prices;     // of each column, the best u; no more than 1
  std::vector<float> fractions;  // of each row: how often its load was above 1, lately more than long ago
};

/// Relaxes the covering constraints of every connected component with multipliers u_j >= 0 of its samples:
///
///   L(u) = sum_j u_j + sum_i min(0, 1 - sum_(j in i) u_j)  <=  size of any cover of the component,
///
/// and climbs L by subgradients with momentum. The best u become integer prices: rounded down to multiples of
/// 1 / price_unit, lowered where a ball would cost more than 1, then raised again where all balls of a sample
/// have room. They go through `prove` (certificate.hpp): rounding up component by component, the certificate
/// proves the bound on the original balls and samples.
///
/// A climb that ends where it began has taken too long a first step: it begins again with a tenth of it, and
/// with return_to_best.
///
/// - The bound ends near the linear programming bound (3.5 without integrality), never above it but for the
///   rounding up. The plain rule (momentum 0) stalls far below.
/// - Nothing is chosen, the matrix stays. Time O(entries) per iteration, memory 12 bytes per entry.
/// - Components are handled in parallel; the result does not depend on the number of threads.
CoverState lagrangian_bound(const CoverState& state, const LagrangianBoundOptions& options = {},
                            Monitor& monitor = no_monitor());

/// Climbs L as lagrangian_bound does, from the multipliers `start` of the columns; empty: their shares in the
/// longest row that contains them. Fractions are an approximate solution of the linear relaxation.
Relaxation relax(const Part& part, const LagrangianBoundOptions& options, std::span<const float> start,
                 Monitor& monitor);

/// Prices of the columns of one component, in 1 / price_unit: no row costs more than 1.
std::vector<std::int32_t> lagrangian_prices(const Part& part, const LagrangianBoundOptions& options,
                                            Monitor& monitor);

/// The same of multipliers: lowered where a row costs more than 1, raised where all rows have room.
std::vector<std::int32_t> feasible_prices(const Part& part, std::span<const float> multipliers,
                                          Monitor& monitor);

}  // namespace ballflow::geometry
