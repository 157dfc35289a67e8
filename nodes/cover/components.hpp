// The independent parts of a covering matrix (Kornberger 2010, 3.6.2).
#pragma once

#include <cstdint>
#include <vector>

#include "types/cover_state.hpp"

namespace ballflow::geometry {

/// Connected components of the incidence graph of rows and columns. A row that covers nothing is in none.
/// Components are numbered by their first column.
struct Components {
  std::vector<std::int32_t> of_row;     // component of each row, -1 for a row that covers nothing
  std::vector<std::int32_t> of_column;  // component of each column
  std::vector<std::int32_t> rows;       // number of rows of each component
  std::vector<std::int32_t> columns;    // number of columns of each component

  std::size_t count() const { return rows.size(); }
};

Components components(const CoverState& state);

}  // namespace ballflow::geometry
