// What VerifyCover found.
#pragma once

#include <cstdint>
#include <string>

#include "base/array.hpp"

namespace ballflow::geometry {

struct CoverCheck {
  std::int64_t balls = 0;
  std::int64_t samples = 0;
  Array<std::int32_t> uncovered;  // samples in no ball, ascending

  // Every cover by the balls of the instance has at least so many, as a certificate proves that was checked
  // against these balls and the samples; -1 when there was none to check.
  std::int64_t certified_bound = -1;
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const CoverCheck& check);

}  // namespace ballflow::geometry
