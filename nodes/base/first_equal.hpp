// Finding equal items.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/index.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

inline std::uint64_t mix_hash(std::uint64_t h, std::uint64_t value) {
  h = (h ^ value) * 0x9e3779b97f4a7c15ull;
  return h ^ (h >> 29);
}

/// For each item the first item equal to it. `hash` and `equal` take item numbers. Throws InputError for 2^31
/// items and more.
template <class Hash, class Equal>
std::vector<std::int32_t> first_equal(std::size_t count, Hash hash, Equal equal) {
  constexpr std::int32_t none = -1;
  index_of(count, "things to compare");
  const std::size_t slots = std::bit_ceil(2 * count + 1);
  std::vector<std::int32_t> table(slots, none);
  std::vector<std::int32_t> first(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t slot = hash(i) & (slots - 1);
    while (table[slot] != none && !equal(static_cast<std::size_t>(table[slot]), i))
      slot = (slot + 1) & (slots - 1);
    if (table[slot] == none) table[slot] = static_cast<std::int32_t>(i);
    first[i] = table[slot];
  }
  return first;
}

/// For each point the first one equal to it. The points must not contain -0.
inline std::vector<std::int32_t> first_equal_point(std::span<const Vec3> points) {
  return first_equal(
      points.size(),
      [&](std::size_t i) {
        const Vec3& p = points[i];
        return mix_hash(
            mix_hash(mix_hash(0, std::bit_cast<std::uint64_t>(p.x)), std::bit_cast<std::uint64_t>(p.y)),
            std::bit_cast<std::uint64_t>(p.z));
      },
      [&](std::size_t a, std::size_t b) { return points[a] == points[b]; });
}

}  // namespace ballflow::geometry
