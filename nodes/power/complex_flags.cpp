#include "power/complex_flags.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <utility>

#include "base/shared_progress.hpp"

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

/// Calls body(c) for all cells, on all cores, and shows it as half of the work from `from` on.
template <class Body>
void for_cells(std::size_t cells, double from, Monitor& monitor, const Body& body) {
  SharedProgress progress(monitor, cells, from, from + 0.5);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells, 4096), [&](const auto& range) {
    for (std::size_t c = range.begin(); c != range.end(); ++c) body(c);
    progress.advance(range.size());
  });
}

}  // namespace

std::vector<std::uint8_t> complex_flags(const CellTable& table, const BallPredicates& predicates,
                                        Monitor& monitor) {
  const std::size_t n = table.size();
  std::vector<std::uint8_t> flags(n);
  for_cells(n, 0, monitor, [&](std::size_t c) {
    const auto& cell = table.cells[c];
    if (!finite(cell)) return;
    const bool meets = table.dimension == 3   ? top_meets<4>(cell, predicates)
                       : table.dimension == 2 ? top_meets<3>(cell, predicates)
                       : table.dimension == 1 ? top_meets<2>(cell, predicates)
                                              : table.dimension == 0;
    if (meets) flags[c] = whole;
  });
  if (table.dimension < 3) return flags;
  // Now threads meet at a cell: each raises other bits of it, and none changes `whole`.
  const auto is_whole = [&](std::size_t c) {
    return (std::atomic_ref(flags[c]).load(std::memory_order_relaxed) & whole) != 0;
  };
  const auto raise = [&](std::size_t c, std::size_t k) {
    std::atomic_ref(flags[c]).fetch_or(static_cast<std::uint8_t>(1U << k), std::memory_order_relaxed);
  };
  for_cells(n, 0.5, monitor, [&](std::size_t c) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t other = at(table.neighbors[c][k]);
      if (other < c) continue;  // met from the other side
      const auto& around = table.neighbors[other];
      const auto back = static_cast<std::size_t>(
          std::find(around.begin(), around.end(), static_cast<std::int32_t>(c)) - around.begin());
      bool in = is_whole(c) || is_whole(other);
      if (!in) {
        const auto facet = facet_of(table.cells[c], k);
        if (facet[0] == infinite || !predicates.meets(facet)) continue;
        const auto attaches = [&](std::int32_t ball) {
          return ball != infinite && predicates.attaches(facet, ball);
        };
        in = !attaches(table.cells[c][k]) && !attaches(table.cells[other][back]);
      }
      if (!in) continue;
      raise(c, k);
      raise(other, back);
    }
  });
  return flags;
}

}  // namespace ballflow::geometry
