// What VerifyCover found.
#pragma once

#include <cstdint>
#include <string>

#include "types/array.hpp"

namespace ballflow::geometry {

struct CoverCheck {
  std::int64_t balls = 0;
  std::int64_t samples = 0;
  Array<std::int32_t> uncovered;  // samples in no ball, ascending
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const CoverCheck& check);

}  // namespace ballflow::geometry
