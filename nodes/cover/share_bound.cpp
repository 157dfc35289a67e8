#include "cover/share_bound.hpp"

#include <algorithm>
#include <vector>

#include "cover/certificate.hpp"
#include "cover/components.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {

CoverState share_bound(const CoverState& state, Monitor& monitor) {
  monitor.step(0);
  if (state.left_out > 0) return state;  // the rows say nothing about the others
  std::vector<std::int64_t> longest(state.cols(), 1);
  Lookout look(monitor);
  for (std::size_t i = 0; i < state.rows(); ++i) {
    const auto row = state.row(i);
    look(row.size());
    for (const std::int32_t c : row) {
      std::int64_t& length = longest[static_cast<std::size_t>(c)];
      length = std::max(length, static_cast<std::int64_t>(row.size()));
    }
  }
  monitor.step(0.5);

  // Shares in units far below 1 / (2^31 samples), rounded down: the bound holds whatever is lost.
  constexpr std::int64_t fine = std::int64_t{1} << 44;
  const Parts parts(state, monitor);
  PricedGroups groups;
  std::int64_t bound = optimal_choices(state);
  for (std::size_t k = 0; k < parts.count(); ++k) {
    std::int64_t whole = 0, rest = 0;
    for (const std::int32_t c : parts.columns(k)) {
      const std::int64_t alpha = longest[static_cast<std::size_t>(c)];
      groups.add(state.column_ids[static_cast<std::size_t>(c)], price_unit / alpha);
      rest += fine / alpha;
      whole += rest / fine;
      rest %= fine;
    }
    groups.close();
    bound += whole + (rest > 0 ? 1 : 0);
  }
  CoverState next = state;
  raise_lower_bound(next, bound, BoundHow::share);
  prove(next, groups);
  monitor.step(1);
  return next;
}

}  // namespace ballflow::geometry
