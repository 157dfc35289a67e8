#include "power/regular_cells.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/index.hpp"
#include "exact/ball_predicates.hpp"
#include "exact/spatial_order.hpp"

namespace ballflow::geometry {
namespace {

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;

/// CGAL's kernel, but for the one predicate that takes most of the time: polar balls are degenerate up to
/// rounding (four and more pass through every sample), where twice as many bits decide what rational numbers
/// would.
struct Kernel : Epick {
  explicit Kernel(bool ordinary = false) : ordinary_(ordinary) {}

  class PowerSide : public Epick::Power_side_of_oriented_power_sphere_3 {
    using Exact = Epick::Power_side_of_oriented_power_sphere_3;
    using Weighted = Epick::Weighted_point_3;

   public:
    explicit PowerSide(bool ordinary) : ordinary_(ordinary) {}
    using Exact::operator();
    CGAL::Oriented_side operator()(const Weighted& p, const Weighted& q, const Weighted& r, const Weighted& s,
                                   const Weighted& t) const {
      if (ordinary_) {
        const int side = quick_power_side(plain(p), plain(q), plain(r), plain(s), plain(t));
        if (side != 0) return side > 0 ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
      }
      return Exact::operator()(p, q, r, s, t);
    }

   private:
    static WeightedPoint plain(const Weighted& p) { return {{p.x(), p.y(), p.z()}, p.weight()}; }
    bool ordinary_;
  };
  using Power_side_of_oriented_power_sphere_3 = PowerSide;
  PowerSide power_side_of_oriented_power_sphere_3_object() const { return PowerSide(ordinary_); }

 private:
  bool ordinary_;  // magnitudes are such that quick_power_side may be asked
};
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Regular_triangulation_cell_base_3<
    Kernel, CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel>, CGAL::Discard_hidden_points>;
// Sequential: parallel insertion of weighted points has data races in CGAL 5.5.
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase, CGAL::Sequential_tag>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, Structure>;

/// One ball per place, in an order that makes insertion fast.
std::vector<std::int32_t> insertion_order(std::span<const Vec3> centers, std::span<const double> weights) {
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
  std::vector<Vec3> places;
  places.reserve(ids.size());
  for (const std::int32_t id : ids) places.push_back(center(id));
  std::vector<std::int32_t> order = spatial_order(places);
  for (std::int32_t& place : order) place = ids[static_cast<std::size_t>(place)];
  return order;
}

Triangulation triangulate(std::span<const Vec3> centers, std::span<const double> weights, Monitor& monitor) {
  const std::vector<std::int32_t> order = insertion_order(centers, weights);
  const bool ordinary = std::all_of(order.begin(), order.end(), [&](std::int32_t id) {
    const Vec3 p = centers[static_cast<std::size_t>(id)];
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= 1e20 &&
           std::abs(weights[static_cast<std::size_t>(id)]) <= 1e40;
  });
  Triangulation triangulation{Kernel(ordinary)};
  Triangulation::Cell_handle hint;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i % 1024 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(order.size()));
    const auto id = static_cast<std::size_t>(order[i]);
    const Vec3 p = centers[id];
    const Kernel::Weighted_point_3 weighted(Kernel::Point_3(p.x, p.y, p.z), weights[id]);
    Triangulation::Locate_type type;
    int li = 0, lj = 0;
    const auto cell = triangulation.locate(weighted, type, li, lj, hint);
    const auto vertex = triangulation.insert(weighted, type, cell, li, lj);
    if (vertex == Triangulation::Vertex_handle()) {
      hint = cell;  // hidden
    } else {
      vertex->info() = order[i];
      hint = vertex->cell();
    }
  }
  return triangulation;
}

}  // namespace

RegularCells regular_cells(std::span<const Vec3> centers, std::span<const double> weights, Monitor& monitor) {
  RegularCells flat;
  if (centers.empty()) return flat;
  index_of(centers.size(), "balls of a power diagram");
  Triangulation triangulation = triangulate(centers, weights, monitor);
  flat.dimension = triangulation.dimension();
  const int corners = flat.dimension + 1;
  triangulation.infinite_vertex()->info() = RegularCells::infinite;

  auto& cells = triangulation.tds().cells();
  index_of(cells.size(), "cells of the power diagram");
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
