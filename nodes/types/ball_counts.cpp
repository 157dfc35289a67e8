#include "types/ball_counts.hpp"

#include <cmath>

namespace ballflow::geometry {

std::string broken_invariant(const BallCounts& counts) {
  if (counts.counts.size() != counts.outside.size()) return "there are not as many volumes as counts";
  for (std::size_t i = 0; i < counts.counts.size(); ++i) {
    if (counts.counts[i] < 1)
      return "object " + std::to_string(i) + " gets " + std::to_string(counts.counts[i]) + " balls";
    if (!std::isfinite(counts.outside[i]) || counts.outside[i] < 0)
      return "the volume outside of object " + std::to_string(i) + " is negative or no number";
  }
  return "";
}

}  // namespace ballflow::geometry
