#include "ellipsoids/select_ellipsoids.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/monitor.hpp"

namespace ballflow::geometry {

Ellipsoids select_ellipsoids(const CoverState& cover, const Ellipsoids& ellipsoids) {
  if (cover.balls != static_cast<std::int64_t>(ellipsoids.size())) {
    throw InputError("the cover is about " + std::to_string(cover.balls) + " ellipsoids, but there are " +
                         std::to_string(ellipsoids.size()),
                     "connect the ellipsoids that the matrix was made of");
  }
  if (cover.remaining() != 0) {
    throw InputError(std::to_string(cover.remaining()) + " samples are not covered by the " +
                         std::to_string(cover.chosen.size()) + " ellipsoids chosen so far",
                     "end the strategy with Greedy (until_covered)");
  }
  std::vector<std::int32_t> ids(cover.chosen.begin(), cover.chosen.end());
  std::sort(ids.begin(), ids.end());
  const bool outside = !ids.empty() && (ids.front() < 0 || ids.back() >= cover.balls);
  if (outside || std::adjacent_find(ids.begin(), ids.end()) != ids.end()) {
    throw InputError(outside ? "an ellipsoid is chosen that there is not" : "an ellipsoid is chosen twice",
                     "the cover is damaged: compute it again");
  }
  return select(ellipsoids, ids);
}

}  // namespace ballflow::geometry
