#include "cover/reduce.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "cover/bandwidth_order.hpp"
#include "cover/certificate.hpp"
#include "cover/dominated_sets.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {
namespace {

using Flags = std::vector<std::uint8_t>;
using Ids = std::vector<std::int32_t>;

/// The matrix in both orientations, and the original ids of what is left of it.
struct Matrix {
  Csr rows, columns;
  Ids row_ids, column_ids;
  Ids row_rank, column_rank;  // SubsetTest::bandwidth: where a row or column is in that order; else empty

  /// Makes the columns from the rows. Old and new ones are never there at once: of large matrices two
  /// orientations are enough to hold beside the input.
  void transpose_rows(std::size_t count, Monitor& monitor) {
    columns = {};
    columns = transpose(rows, count, monitor);
  }
  void erase_rows(const Flags& gone) {
    erase(row_ids, gone);
    erase(row_rank, gone);
  }
  void erase_columns(const Flags& gone) {
    erase(column_ids, gone);
    erase(column_rank, gone);
  }

 private:
  static void erase(Ids& ids, const Flags& gone) {
    std::size_t k = 0;
    std::erase_if(ids, [&](std::int32_t) { return gone[k++] != 0; });
  }
};

/// `sets` without those in `gone_sets` and without the elements in `gone_elements`, renumbered. `shrunk`
/// becomes the new numbers of the sets that lost elements.
Csr without(const Csr& sets, const Flags& gone_sets, const Flags& gone_elements, Ids& shrunk,
            Monitor& monitor) {
  const bool all_elements = std::find(gone_elements.begin(), gone_elements.end(), 1) == gone_elements.end();
  std::vector<std::int32_t> number(gone_elements.size(), -1);
  std::int32_t next = 0;
  for (std::size_t e = 0; e < number.size(); ++e) {
    if (gone_elements[e] == 0) number[e] = next++;
  }
  std::vector<std::int64_t> offsets{0};
  std::size_t most = 0;
  for (std::size_t i = 0; i < sets.size(); ++i) most += gone_sets[i] == 0 ? sets.degree(i) : 0;
  auto entries = zeros<std::int32_t>(most, monitor);
  std::size_t size = 0;
  Lookout look(monitor);
  shrunk.clear();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (gone_sets[i] != 0) continue;
    const auto set = sets[i];
    look(set.size());
    if (all_elements) {
      std::copy(set.begin(), set.end(), entries.begin() + static_cast<std::ptrdiff_t>(size));
      size += set.size();
    } else {
      for (const std::int32_t e : set) {
        entries[size] = number[static_cast<std::size_t>(e)];
        size += entries[size] >= 0 ? 1 : 0;
      }
    }
    const auto degree = static_cast<std::size_t>(static_cast<std::int64_t>(size) - offsets.back());
    if (degree < set.size()) shrunk.push_back(static_cast<std::int32_t>(offsets.size() - 1));
    offsets.push_back(static_cast<std::int64_t>(size));
  }
  entries.resize(size);
  return {std::move(offsets), std::move(entries)};
}

bool any(const Flags& flags) { return std::find(flags.begin(), flags.end(), 1) != flags.end(); }

Ids all_of(std::size_t count) {
  Ids ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

}  // namespace

CoverState reduce(const CoverState& state, const ReduceOptions& options, Monitor& monitor,
                  ReduceStatistics* statistics) {
  monitor.step(0);
  Matrix matrix{rows_of(state),
                transpose(rows_of(state), state.cols(), monitor),
                Ids(state.row_ids.begin(), state.row_ids.end()),
                Ids(state.column_ids.begin(), state.column_ids.end()),
                {},
                {}};
  if (options.subset_test == SubsetTest::bandwidth) {
    BandwidthOrder order = bandwidth_order(matrix.rows, matrix.columns, monitor);
    matrix.row_rank = std::move(order.row_rank);
    matrix.column_rank = std::move(order.column_rank);
  }
  ReduceStatistics counts;
  Ids chosen(state.chosen.begin(), state.chosen.end());
  std::vector<std::uint8_t> chosen_how(state.chosen_how.begin(), state.chosen_how.end());
  PricedGroups witnesses;  // of the essential balls
  Ids dirty_rows = all_of(matrix.rows.size()), dirty_columns = all_of(matrix.columns.size());

  for (int round = 1; !dirty_rows.empty() || !dirty_columns.empty(); ++round) {
    monitor.step(1 - 1.0 / round);
    const Flags none_of_columns(matrix.columns.size());
    const Flags gone_rows =
        dominated_sets({matrix.rows, matrix.columns, options.subset_test, matrix.column_rank}, Keep::maximal,
                       dirty_rows, counts, monitor);
    dirty_rows.clear();
    if (any(gone_rows)) {
      const Array<std::int64_t> before = matrix.columns.offsets;
      Ids unchanged;
      matrix.rows = without(matrix.rows, gone_rows, none_of_columns, unchanged, monitor);
      matrix.transpose_rows(none_of_columns.size(), monitor);
      matrix.erase_rows(gone_rows);
      for (std::size_t c = 0; round > 1 && c < matrix.columns.size(); ++c) {
        if (static_cast<std::int64_t>(matrix.columns.degree(c)) < before[c + 1] - before[c]) {
          dirty_columns.push_back(static_cast<std::int32_t>(c));
        }
      }
    }
    if (dirty_columns.empty()) continue;

    monitor.step(1 - 1.0 / (round + 0.5));
    Flags gone_columns = dominated_sets({matrix.columns, matrix.rows, options.subset_test, matrix.row_rank},
                                        Keep::minimal, dirty_columns, counts, monitor);
    dirty_columns.clear();
    // A column of one row is in all other columns of that row, which have just been marked: the choice
    // takes this column and its row, nothing else.
    Flags essential(matrix.rows.size());
    Ids witness(matrix.rows.size());
    for (std::size_t c = 0; c < matrix.columns.size(); ++c) {
      if (gone_columns[c] != 0 || matrix.columns.degree(c) != 1) continue;
      gone_columns[c] = 1;
      essential[static_cast<std::size_t>(matrix.columns[c][0])] = 1;
      witness[static_cast<std::size_t>(matrix.columns[c][0])] = matrix.column_ids[c];
    }
    for (std::size_t i = 0; i < essential.size(); ++i) {
      if (essential[i] == 0) continue;
      chosen.push_back(matrix.row_ids[i]);
      chosen_how.push_back(
          static_cast<std::uint8_t>(state.left_out > 0 ? Choice::searched : Choice::essential));
      witnesses.add(witness[i], price_unit);
      witnesses.close();
    }
    if (any(gone_columns)) {
      const auto kept = std::count(gone_columns.begin(), gone_columns.end(), 0);
      matrix.columns = {};
      matrix.rows = without(matrix.rows, essential, gone_columns, dirty_rows, monitor);
      matrix.transpose_rows(static_cast<std::size_t>(kept), monitor);
      matrix.erase_columns(gone_columns);
      matrix.erase_rows(essential);
    }
  }

  CoverState next = state;
  next.row_offsets = matrix.rows.offsets;
  next.columns = matrix.rows.entries;
  next.row_ids = std::move(matrix.row_ids);
  next.column_ids = std::move(matrix.column_ids);
  next.chosen = std::move(chosen);
  next.chosen_how = std::move(chosen_how);
  settle(next, witnesses);
  raise_lower_bound(next);
  if (statistics != nullptr) *statistics = counts;
  monitor.step(1);
  return next;
}

}  // namespace ballflow::geometry
