#include "cover/near_order.hpp"

#include <cstddef>

namespace ballflow::geometry {

NearOrder near_order(const Csr& rows, const Csr& columns, Monitor& monitor) {
  constexpr std::int32_t patch = 128;  // rows
  NearOrder order{std::vector<std::int32_t>(rows.size(), -1), std::vector<std::int32_t>(columns.size(), -1)};
  std::int32_t next_row = 0, next_column = 0;
  std::vector<std::int32_t> firsts, near;
  std::vector<std::int32_t> met_in(rows.size(), -1);  // the last patch that met a row
  std::int32_t patches = 0;
  Lookout look(monitor);
  const auto grow_patch = [&](std::int32_t first) {
    near.assign(1, first);
    met_in[static_cast<std::size_t>(first)] = patches;
    const std::int32_t end = next_row + patch;
    std::size_t taken = 0;
    for (; taken < near.size() && next_row < end; ++taken) {
      const auto i = static_cast<std::size_t>(near[taken]);
      order.row_rank[i] = next_row++;
      look(rows.degree(i));
      for (const std::int32_t c : rows[i]) {
        std::int32_t& rank = order.column_rank[static_cast<std::size_t>(c)];
        if (rank >= 0) continue;
        rank = next_column++;
        look(columns.degree(static_cast<std::size_t>(c)));
        for (const std::int32_t k : columns[static_cast<std::size_t>(c)]) {
          std::int32_t& met = met_in[static_cast<std::size_t>(k)];
          if (met == patches || order.row_rank[static_cast<std::size_t>(k)] >= 0) continue;
          met = patches;
          near.push_back(k);
        }
      }
    }
    firsts.insert(firsts.end(), near.begin() + static_cast<std::ptrdiff_t>(taken), near.end());
    ++patches;
  };
  for (std::size_t start = 0; start < rows.size(); ++start) {
    if (order.row_rank[start] >= 0) continue;
    firsts.assign(1, static_cast<std::int32_t>(start));
    for (std::size_t k = 0; k < firsts.size(); ++k) {
      if (order.row_rank[static_cast<std::size_t>(firsts[k])] < 0) grow_patch(firsts[k]);
    }
  }
  for (std::int32_t& rank : order.column_rank) {
    if (rank < 0) rank = next_column++;  // no row covers it
  }
  return order;
}

std::vector<std::int32_t> inverse(const std::vector<std::int32_t>& rank) {
  std::vector<std::int32_t> of(rank.size());
  for (std::size_t i = 0; i < rank.size(); ++i) {
    of[static_cast<std::size_t>(rank[i])] = static_cast<std::int32_t>(i);
  }
  return of;
}

}  // namespace ballflow::geometry
