#include "power/regular_cells.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Regular_triangulation_cell_base_3<
    Kernel, CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel>, CGAL::Discard_hidden_points>;
// Sequential: parallel insertion of weighted points has data races in CGAL 5.5.
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase, CGAL::Sequential_tag>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, Structure>;
using Site = std::pair<Kernel::Point_3, std::int32_t>;

/// One point per place, in an order that makes insertion fast.
std::vector<Site> sites_in_space_order(std::span<const Vec3> centers, std::span<const double> weights) {
  std::vector<std::int32_t> ids(centers.size());
  std::iota(ids.begin(), ids.end(), 0);
  const auto center = [&](std::int32_t id) { return centers[static_cast<std::size_t>(id)]; };
  const auto weight = [&](std::int32_t id) { return weights[static_cast<std::size_t>(id)]; };
  std::sort(ids.begin(), ids.end(), [&](std::int32_t a, std::int32_t b) {
    const Vec3 p = center(a), q = center(b);
    return std::tuple(p.x, p.y, p.z, -weight(a), a) < std::tuple(q.x, q.y, q.z, -weight(b), b);
  });
  ids.erase(std::unique(ids.begin(), ids.end(),
                        [&](std::int32_t a, std::int32_t b) { return center(a) == center(b); }),
            ids.end());
  std::vector<Site> sites;
  sites.reserve(ids.size());
  for (const std::int32_t id : ids) {
    const Vec3 p = center(id);
    sites.emplace_back(Kernel::Point_3(p.x, p.y, p.z), id);
  }
  using Order = CGAL::Spatial_sort_traits_adapter_3<Kernel, CGAL::First_of_pair_property_map<Site>>;
  CGAL::spatial_sort(sites.begin(), sites.end(), Order());
  return sites;
}

Triangulation triangulate(const std::vector<Site>& sites, std::span<const double> weights, Monitor& monitor) {
  Triangulation triangulation;
  Triangulation::Cell_handle hint;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (i % 1024 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(sites.size()));
    const auto& [point, id] = sites[i];
    const Kernel::Weighted_point_3 weighted(point, weights[static_cast<std::size_t>(id)]);
    Triangulation::Locate_type type;
    int li = 0, lj = 0;
    const auto cell = triangulation.locate(weighted, type, li, lj, hint);
    const auto vertex = triangulation.insert(weighted, type, cell, li, lj);
    if (vertex == Triangulation::Vertex_handle()) {
      hint = cell;  // hidden
    } else {
      vertex->info() = id;
      hint = vertex->cell();
    }
  }
  return triangulation;
}

}  // namespace

RegularCells regular_cells(std::span<const Vec3> centers, std::span<const double> weights, Monitor& monitor) {
  RegularCells flat;
  if (centers.empty()) return flat;
  Triangulation triangulation = triangulate(sites_in_space_order(centers, weights), weights, monitor);
  flat.dimension = triangulation.dimension();
  const int corners = flat.dimension + 1;
  triangulation.infinite_vertex()->info() = RegularCells::infinite;

  auto& cells = triangulation.tds().cells();
  std::int32_t count = 0;
  for (auto cell = cells.begin(); cell != cells.end(); ++cell) cell->info() = count++;
  constexpr std::array<std::int32_t, 4> empty{RegularCells::none, RegularCells::none, RegularCells::none,
                                              RegularCells::none};
  flat.cells.assign(static_cast<std::size_t>(count), empty);
  flat.neighbors.assign(static_cast<std::size_t>(count), empty);
  for (auto cell = cells.begin(); cell != cells.end(); ++cell) {
    const auto at = static_cast<std::size_t>(cell->info());
    for (int i = 0; i < corners; ++i) {
      flat.cells[at][static_cast<std::size_t>(i)] = cell->vertex(i)->info();
      flat.neighbors[at][static_cast<std::size_t>(i)] = cell->neighbor(i)->info();
    }
  }
  return flat;
}

}  // namespace ballflow::geometry
