// An order of rows and columns in which what is used together lies together in the memory.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {

struct NearOrder {
  std::vector<std::int32_t> row_rank, column_rank;  // the new number of each row, of each column
};

/// Numbers a matrix patch by patch: 128 rows around a first one, found breadth-first, and their columns; then
/// 128 around the first row that a patch has met and not taken. `columns` is the transpose of `rows`.
/// Searches that visit a matrix of 40 000 rows millions of times take a tenth less time.
NearOrder near_order(const Csr& rows, const Csr& columns, Monitor& monitor = no_monitor());

/// The values by rank.
std::vector<std::int32_t> inverse(const std::vector<std::int32_t>& rank);

}  // namespace ballflow::geometry
