#include "axis/delaunay_table.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <cstddef>

#include "axis/delaunay_cells_of.hpp"
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
  return delaunay_cells_of(triangulation, monitor);
}

}  // namespace ballflow::geometry
