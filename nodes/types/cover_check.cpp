#include "types/cover_check.hpp"

namespace ballflow::geometry {

std::string broken_invariant(const CoverCheck& check) {
  if (check.balls < 0) return "the number of balls is " + std::to_string(check.balls);
  if (check.samples < 0) return "the number of samples is " + std::to_string(check.samples);
  if (check.certified_bound < -1) return "the certified bound is " + std::to_string(check.certified_bound);
  std::int64_t previous = -1;
  for (std::size_t i = 0; i < check.uncovered.size(); ++i) {
    const std::int64_t sample = check.uncovered[i];
    const std::string place = "uncovered[" + std::to_string(i) + "] = " + std::to_string(sample);
    if (sample < 0 || sample >= check.samples) {
      return place + " is out of range (" + std::to_string(check.samples) + " samples)";
    }
    if (sample <= previous) return place + " does not ascend";
    previous = sample;
  }
  return {};
}

}  // namespace ballflow::geometry
