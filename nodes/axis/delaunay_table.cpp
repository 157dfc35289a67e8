#include "axis/delaunay_table.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cstddef>

#include "exact/spatial_order.hpp"

namespace ballflow::geometry {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

std::vector<DelaunayCell> delaunay_cells(std::span<const Vec3> points, Monitor& monitor) {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
  using Cell = CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel>;
  using Triangulation =
      CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
  std::vector<Kernel::Point_3> sites;
  sites.reserve(points.size());
  for (const Vec3& p : points) sites.emplace_back(p.x, p.y, p.z);
  const std::vector<std::int32_t> order = spatial_order(points);
  Triangulation triangulation;
  Triangulation::Cell_handle hint;
  for (std::size_t i = 0; i < order.size(); ++i) {  // one by one, to look at the monitor in between
    if (i % 512 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(order.size()));
    const auto vertex = triangulation.insert(sites[static_cast<std::size_t>(order[i])], hint);
    vertex->info() = order[i];
    hint = vertex->cell();
  }
  if (triangulation.dimension() < 3) return {};

  struct Entry {
    std::array<std::int32_t, 4> corners;
    std::array<std::int8_t, 4> place;  // of corners[k] among the vertices of the cell
    Triangulation::Cell_handle cell;
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
