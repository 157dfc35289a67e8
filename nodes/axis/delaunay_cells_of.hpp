// What a triangulation of CGAL becomes: the table of delaunay_table.hpp. Seen by .cpp files only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "axis/delaunay_table.hpp"

namespace ballflow::geometry {

/// `Triangulation` is three-dimensional, has the index of its point as the info of every vertex, and room for
/// an index as the info of every cell.
template <class Triangulation>
std::vector<DelaunayCell> delaunay_cells_of(Triangulation& triangulation, Monitor& monitor) {
  struct Entry {
    std::array<std::int32_t, 4> corners;
    std::array<std::int8_t, 4> place;  // of corners[k] among the vertices of the cell
    typename Triangulation::Cell_handle cell;
  };
  std::vector<Entry> entries;
  entries.reserve(triangulation.number_of_cells());
  triangulation.infinite_vertex()->info() = DelaunayCell::infinite;
  Lookout look(monitor);
  for (auto cell = triangulation.all_cells_begin(); cell != triangulation.all_cells_end(); ++cell) {
    look(32);
    Entry entry{{}, {0, 1, 2, 3}, cell};
    const auto name = [&](int k) { return cell->vertex(k)->info(); };
    std::sort(entry.place.begin(), entry.place.end(), [&](int a, int b) { return name(a) < name(b); });
    for (std::size_t k = 0; k < 4; ++k) entry.corners[k] = name(entry.place[k]);
    entries.push_back(entry);
  }
  monitor.step(0.9);
  std::sort(entries.begin(), entries.end(), [&look](const Entry& a, const Entry& b) {
    look(4);
    return a.corners < b.corners;
  });
  monitor.step(0.95);
  for (std::size_t i = 0; i < entries.size(); ++i) entries[i].cell->info() = static_cast<std::int32_t>(i);
  std::vector<DelaunayCell> cells;
  cells.reserve(entries.size());
  for (const Entry& entry : entries) {
    look(16);
    DelaunayCell cell{entry.corners, {}};
    for (std::size_t k = 0; k < 4; ++k) cell.neighbors[k] = entry.cell->neighbor(entry.place[k])->info();
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace ballflow::geometry
