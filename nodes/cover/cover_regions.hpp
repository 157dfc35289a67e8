// Pieces of a cover that can be improved side by side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/lists.hpp"
#include "base/monitor.hpp"
#include "cover/components.hpp"

namespace ballflow::geometry {

/// A cover of `part` (rows, each once) cut into regions of at most `largest` rows: the region of each of its
/// rows. Two rows are neighbours when they share a column. The cover is halved again and again, about in the
/// middle of a breadth-first order that begins at an end of what is halved; `seed` says where exactly, so
/// that other seeds make other borders.
std::vector<std::int32_t> regions_of_cover(const Part& part, std::span<const std::int32_t> cover,
                                           std::size_t largest, std::uint64_t seed,
                                           Monitor& monitor = no_monitor());

/// What the regions of a cover are responsible for.
struct RegionColumns {
  std::vector<std::int32_t> of_column;  // the lowest region that covers a column
  std::size_t shared = 0;               // columns that more than one region covers
  Lists<std::int32_t> rows;             // rows that meet columns of each region, ascending
};

/// Every column goes to the lowest one of the regions that cover it. Whatever covers of its columns regions
/// find, together these are a cover. Looks at rows alone: part.columns may be empty.
RegionColumns columns_of_regions(const Part& part, std::span<const std::int32_t> cover,
                                 std::span<const std::int32_t> region_of_cover,
                                 Monitor& monitor = no_monitor());

/// One region as a matrix of its own: its columns, and all rows that meet them. Numbers are those of `part`.
/// Looks at part.rows alone. Safe to call from several threads at once.
Part region_part(const Part& part, const RegionColumns& regions, std::int32_t region,
                 Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
