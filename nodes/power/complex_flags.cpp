#include "power/complex_flags.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace ballflow::geometry {
namespace {

constexpr std::int32_t infinite = PowerDiagram::infinite;
constexpr std::uint8_t whole = PowerDiagram::whole;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

template <std::size_t N>
bool top_meets(const std::array<std::int32_t, 4>& cell, const BallPredicates& predicates) {
  std::array<std::int32_t, N> top{};
  std::copy_n(cell.begin(), N, top.begin());
  std::sort(top.begin(), top.end());
  return predicates.meets(top);
}

bool finite(const std::array<std::int32_t, 4>& cell) {
  return std::find(cell.begin(), cell.end(), infinite) == cell.end();
}

/// Predicates see ascending balls, so that no answer depends on how a cell is written down.
std::array<std::int32_t, 3> facet_of(const std::array<std::int32_t, 4>& cell, std::size_t k) {
  std::array<std::int32_t, 3> f{cell[(k + 1) & 3], cell[(k + 2) & 3], cell[(k + 3) & 3]};
  if (f[1] < f[0]) std::swap(f[0], f[1]);
  if (f[2] < f[1]) std::swap(f[1], f[2]);
  if (f[1] < f[0]) std::swap(f[0], f[1]);
  return f;
}

}  // namespace

std::vector<std::uint8_t> complex_flags(const CellTable& table, const BallPredicates& predicates,
                                        Monitor& monitor) {
  const std::size_t n = table.size();
  std::vector<std::uint8_t> flags(n);
  const auto step = [&](double from, std::size_t c) {
    if (c % 4096 == 0) monitor.step(from + 0.5 * static_cast<double>(c) / static_cast<double>(n));
  };
  for (std::size_t c = 0; c < n; ++c) {
    step(0, c);
    const auto& cell = table.cells[c];
    if (!finite(cell)) continue;
    const bool meets = table.dimension == 3   ? top_meets<4>(cell, predicates)
                       : table.dimension == 2 ? top_meets<3>(cell, predicates)
                       : table.dimension == 1 ? top_meets<2>(cell, predicates)
                                              : table.dimension == 0;
    if (meets) flags[c] = whole;
  }
  if (table.dimension < 3) return flags;
  for (std::size_t c = 0; c < n; ++c) {
    step(0.5, c);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t other = at(table.neighbors[c][k]);
      if (other < c) continue;  // met from the other side
      const auto& around = table.neighbors[other];
      const auto back = static_cast<std::size_t>(
          std::find(around.begin(), around.end(), static_cast<std::int32_t>(c)) - around.begin());
      bool in = ((flags[c] | flags[other]) & whole) != 0;
      if (!in) {
        const auto facet = facet_of(table.cells[c], k);
        if (facet[0] == infinite || !predicates.meets(facet)) continue;
        const auto attaches = [&](std::int32_t ball) {
          return ball != infinite && predicates.attaches(facet, ball);
        };
        in = !attaches(table.cells[c][k]) && !attaches(table.cells[other][back]);
      }
      if (!in) continue;
      flags[c] |= static_cast<std::uint8_t>(1U << k);
      flags[other] |= static_cast<std::uint8_t>(1U << back);
    }
  }
  return flags;
}

}  // namespace ballflow::geometry
