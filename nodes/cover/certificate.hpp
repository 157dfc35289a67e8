// Certificates of lower bounds: what anybody can check on the original balls and samples (see CoverState).
//
// Why prices of the residual hold for the original instance: a ball that Reduce removed met, of the samples
// that were left, only samples of a ball that stayed or was chosen (chains of dominated balls end in one of
// these), and a chosen ball meets no sample that is left. So whatever the residual's balls may contain
// without breaking conditions (1) and (2), no other ball of the original instance contains more of it.
//   - The residual: any prices under which no row costs more than 1, in groups that no row joins.
//   - An essential ball: the sample that only it covered, price 1. When it was chosen, every ball that
//     contains this sample was dominated by it, and met nothing that was left after the choice.
//   - A component solved exactly: prices of its own columns, one group.
// Picks of other kinds only take samples away, which are then not listed.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/cover_state.hpp"

namespace ballflow::geometry {

/// Samples (original indices) and their prices, group after group.
struct PricedGroups {
  std::vector<std::int32_t> samples;  // ascending within a group
  std::vector<std::int32_t> prices;   // of 1 / price_unit
  std::vector<std::size_t> ends;      // where each group ends; a group is not empty

  /// Samples of price 0 need not be listed: they are left out.
  void add(std::int32_t sample, std::int64_t price);
  /// Ends the group of the samples added since the last one, if there were any.
  void close();

  std::int64_t bound() const;  // sum over the groups of ceil(sum of prices)
};

/// Groups of the columns of the matrix that have a price, as small as condition (2) allows: two columns are
/// in one group if a row contains both, or a chain of such pairs connects them. Columns of price 0 connect
/// nothing, so there may be more groups than components, and each is rounded up.
PricedGroups priced_groups(const CoverState& state, const std::vector<std::int32_t>& price,
                           Monitor& monitor = no_monitor());

/// settle() and prove() do nothing where the matrix leaves balls out: prices that suit its rows need not suit
/// the others.

/// Takes over groups about samples that essential or exact choices have just taken out of the matrix. Groups
/// about the matrix as it was before are dropped, unless the certificate proves more with them: then the
/// certificate stays as it was. Raises the lower bound.
void settle(CoverState& state, const PricedGroups& groups);

/// Proposes prices for the columns of the matrix. The certificate becomes the settled groups and these, if
/// that proves more than before. Raises the lower bound, also by the sum of the optimal choices and what
/// `groups` prove.
void prove(CoverState& state, const PricedGroups& groups);

}  // namespace ballflow::geometry
