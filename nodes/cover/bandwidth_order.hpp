// An order of rows and columns that keeps the entries of a matrix near its diagonal.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {

struct BandwidthOrder {
  std::vector<std::int32_t> row_rank, column_rank;  // the new number of each row, of each column
};

/// Breadth-first numbering, the variant of Cuthill and McKee's algorithm in Listing 3.3 of Kornberger's
/// thesis: every search begins at a vertex of least degree, and goes on to neighbours by degree; ties go to
/// rows before columns, then to the lowest number. `columns` is the transpose of `rows`.
BandwidthOrder bandwidth_order(const Csr& rows, const Csr& columns, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
