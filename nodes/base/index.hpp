// Numbers of things as 32-bit indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "base/monitor.hpp"

namespace ballflow::geometry {

inline constexpr std::size_t most_indices = std::numeric_limits<std::int32_t>::max();

[[noreturn]] inline void refuse_count(std::size_t count, const char* things) {
  throw InputError(
      std::to_string(count) + " " + things + " are more than 2^31 - 1, which 32-bit indices can tell apart",
      "thin the sample, or use fewer balls or samples");
}

/// `count` of `things` ("cells of a triangulation"), or the number of one of them, as an index. Throws
/// InputError beyond 2^31 - 1: sizes of tables that grow faster than their inputs go through here.
inline std::int32_t index_of(std::size_t count, const char* things) {
  if (count > most_indices) [[unlikely]] {
    refuse_count(count, things);
  }
  return static_cast<std::int32_t>(count);
}

}  // namespace ballflow::geometry
