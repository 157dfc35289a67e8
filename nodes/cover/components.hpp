// The independent parts of a covering matrix (Kornberger 2010, 3.6.2).
#pragma once

#include <cstdint>
#include <vector>

#include "base/lists.hpp"
#include "base/monitor.hpp"
#include "cover/residual.hpp"
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

Components components(const CoverState& state, Monitor& monitor = no_monitor());

/// One component as a matrix of its own: row i of it is row row_ids[i] of the whole, column c is column
/// column_ids[c]; both ascend.
struct Part {
  std::vector<std::int32_t> row_ids, column_ids;
  Csr rows, columns;
};

/// The components one by one, without looking at the whole matrix for each.
class Parts {
 public:
  explicit Parts(const CoverState& state, Monitor& monitor = no_monitor());

  std::size_t count() const { return components_.count(); }
  std::span<const std::int32_t> rows(std::size_t k) const { return rows_[k]; }
  std::span<const std::int32_t> columns(std::size_t k) const { return columns_[k]; }
  /// A row of component k that covers all of it, the first; -1 if there is none.
  std::int32_t whole_row(std::size_t k) const;
  /// Safe to call from several threads at once.
  Part part(std::size_t k, Monitor& monitor = no_monitor()) const;

 private:
  const CoverState& state_;
  Components components_;
  Lists<std::int32_t> rows_, columns_;  // of each component
  std::vector<std::int32_t> number_;    // of each column in its component
};

}  // namespace ballflow::geometry
