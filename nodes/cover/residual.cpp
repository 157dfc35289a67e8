#include "cover/residual.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace ballflow::geometry {

Csr transpose(const Csr& rows, std::size_t columns, Monitor& monitor) {
  Lookout look(monitor);
  std::vector<std::int64_t> offsets(columns + 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    look(rows.degree(i));
    for (const std::int32_t c : rows[i]) ++offsets[static_cast<std::size_t>(c) + 1];
  }
  for (std::size_t c = 0; c < columns; ++c) offsets[c + 1] += offsets[c];
  std::vector<std::int64_t> next(offsets.begin(), offsets.end() - 1);
  auto entries = zeros<std::int32_t>(rows.entries.size(), monitor);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    look(rows.degree(i));
    for (const std::int32_t c : rows[i]) {
      entries[static_cast<std::size_t>(next[static_cast<std::size_t>(c)]++)] = static_cast<std::int32_t>(i);
    }
  }
  return {std::move(offsets), std::move(entries)};
}

CoverState choose(const CoverState& state, std::span<const std::int32_t> rows, Choice how, Monitor& monitor) {
  Lookout look(monitor);
  CoverState next = state;
  std::vector<std::int32_t> chosen(state.chosen.begin(), state.chosen.end());
  std::vector<std::uint8_t> chosen_how(state.chosen_how.begin(), state.chosen_how.end());
  std::vector<std::uint8_t> gone_row(state.rows()), gone_column(state.cols());
  for (const std::int32_t row : rows) {
    const auto i = static_cast<std::size_t>(row);
    look(state.row(i).size());
    gone_row[i] = 1;
    for (const std::int32_t c : state.row(i)) gone_column[static_cast<std::size_t>(c)] = 1;
    chosen.push_back(state.row_ids[i]);
    chosen_how.push_back(static_cast<std::uint8_t>(how));
  }

  std::vector<std::int32_t> number(state.cols(), -1), column_ids;
  for (std::size_t c = 0; c < state.cols(); ++c) {
    if (gone_column[c] != 0) continue;
    number[c] = static_cast<std::int32_t>(column_ids.size());
    column_ids.push_back(state.column_ids[c]);
  }
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> columns, row_ids;
  columns.reserve(state.nnz());  // growing would copy gigabytes at once; what is not used is never touched
  for (std::size_t i = 0; i < state.rows(); ++i) {
    if (gone_row[i] != 0) continue;
    look(state.row(i).size());
    for (const std::int32_t c : state.row(i)) {
      if (const std::int32_t k = number[static_cast<std::size_t>(c)]; k >= 0) columns.push_back(k);
    }
    if (static_cast<std::int64_t>(columns.size()) == offsets.back()) continue;
    offsets.push_back(static_cast<std::int64_t>(columns.size()));
    row_ids.push_back(state.row_ids[i]);
  }
  next.chosen = std::move(chosen);
  next.chosen_how = std::move(chosen_how);
  next.row_offsets = std::move(offsets);
  next.columns = std::move(columns);
  next.row_ids = std::move(row_ids);
  next.column_ids = std::move(column_ids);
  return next;
}

std::int64_t optimal_choices(const CoverState& state) {
  return state.count(Choice::essential) + state.count(Choice::exact);
}

void raise_lower_bound(CoverState& state, std::int64_t bound, BoundHow how) {
  if (state.left_out > 0 && how != BoundHow::certified) return;
  const auto ground = static_cast<std::uint8_t>(how);
  if (bound < state.lower_bound || (bound == state.lower_bound && ground <= state.lower_bound_how)) return;
  state.lower_bound = bound;
  state.lower_bound_how = ground;
}

void raise_lower_bound(CoverState& state) {
  std::int64_t longest = 1;
  for (std::size_t i = 0; i < state.rows(); ++i) {
    longest = std::max(longest, state.row_offsets[i + 1] - state.row_offsets[i]);
  }
  const std::int64_t rest = (static_cast<std::int64_t>(state.cols()) + longest - 1) / longest;
  raise_lower_bound(state, optimal_choices(state) + rest, BoundHow::lemma_3_7);
}

}  // namespace ballflow::geometry
