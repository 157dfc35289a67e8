// Linear algebra over Z/2 by plain column reduction: the oracle for everything that says it is homology.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "types/medial_axis.hpp"
#include "types/topology_table.hpp"

namespace ballflow::test {

/// Rank over Z/2 of a matrix given by its columns.
inline std::int64_t rank(std::vector<std::set<std::int64_t>> columns) {
  std::map<std::int64_t, std::size_t> pivots;
  std::int64_t result = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    auto& column = columns[i];
    while (!column.empty()) {
      const auto [pivot, is_new] = pivots.emplace(*column.rbegin(), i);
      if (is_new) {
        ++result;
        break;
      }
      for (const std::int64_t row : columns[pivot->second]) {
        if (!column.insert(row).second) column.erase(row);
      }
    }
  }
  return result;
}

/// Betti numbers of the polygon complex by linear algebra over Z/2.
inline geometry::Betti betti_of(const geometry::MedialAxis& axis) {
  std::map<std::array<std::int32_t, 2>, std::int64_t> edges;
  const auto edge = [&edges](std::int32_t a, std::int32_t b) {
    return edges.emplace(std::array{std::min(a, b), std::max(a, b)}, static_cast<std::int64_t>(edges.size()))
        .first->second;
  };
  std::vector<std::set<std::int64_t>> polygons;
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    const auto p = axis.polygon(i);
    std::set<std::int64_t> sides;
    for (std::size_t k = 0; k < p.size(); ++k) sides.insert(edge(p[k], p[(k + 1) % p.size()]));
    polygons.push_back(sides);
  }
  for (const auto& e : axis.edges) edge(e[0], e[1]);
  std::vector<std::set<std::int64_t>> ends(edges.size());
  for (const auto& [e, id] : edges) ends[static_cast<std::size_t>(id)] = {e[0], e[1]};
  const auto v = static_cast<std::int64_t>(axis.vertices.size());
  const auto e = static_cast<std::int64_t>(edges.size());
  const auto f = static_cast<std::int64_t>(polygons.size());
  const std::int64_t r1 = rank(ends), r2 = rank(polygons);
  return {v - r1, e - r1 - r2, f - r2};
}

}  // namespace ballflow::test
