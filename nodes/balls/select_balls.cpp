#include "balls/select_balls.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/monitor.hpp"

namespace ballflow::geometry {

Balls select_balls(const CoverState& cover, const Balls& balls, const SelectBallsOptions& options) {
  if (cover.balls != static_cast<std::int64_t>(balls.size())) {
    throw InputError("the cover is about " + std::to_string(cover.balls) + " balls, but there are " +
                         std::to_string(balls.size()),
                     "connect the balls that the covering matrix returned with the cover");
  }
  if (cover.remaining() != 0 && !options.allow_unfinished) {
    throw InputError(std::to_string(cover.remaining()) + " samples are not covered by the " +
                         std::to_string(cover.chosen.size()) + " balls chosen so far",
                     "end the strategy with Greedy (until_covered), or set allow_unfinished");
  }
  std::vector<std::int32_t> ids(cover.chosen.begin(), cover.chosen.end());
  std::sort(ids.begin(), ids.end());
  if (!ids.empty() && (ids.front() < 0 || ids.back() >= cover.balls)) {
    throw InputError("ball " + std::to_string(ids.front() < 0 ? ids.front() : ids.back()) +
                         " is chosen, but indices run from 0 to " + std::to_string(cover.balls - 1),
                     "the cover is damaged: compute it again");
  }
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) {
    throw InputError("ball " + std::to_string(*twice) + " is chosen twice",
                     "the cover is damaged: compute it again");
  }
  return select(balls, ids);
}

}  // namespace ballflow::geometry
