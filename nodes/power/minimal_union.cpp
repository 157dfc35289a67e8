#include "power/minimal_union.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "base/index.hpp"
#include "exact/spatial_order.hpp"
#include "power/contribution.hpp"
#include "power/regular_cells.hpp"
#include "power/usable_balls.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
double weight_of(const Balls& balls, std::size_t i) { return balls.radii[i] * balls.radii[i]; }

/// Whether the orthocenter of a cell lies in the union, once it was computed.
enum class Place : std::uint8_t { unknown, inside, outside };
struct CellInfo {
  Place place = Place::unknown;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Regular_triangulation_cell_base_3<
    Kernel, CGAL::Triangulation_cell_base_with_info_3<CellInfo, Kernel>, CGAL::Discard_hidden_points>;
// Sequential: parallel insertion of weighted points has data races in CGAL 5.5.
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase, CGAL::Sequential_tag>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, Structure>;
using Vertex = Triangulation::Vertex_handle;
using Cell = Triangulation::Cell_handle;
using WeightedPoint = Kernel::Weighted_point_3;

/// Which balls contribute, of those that are in a cell.
std::vector<std::int32_t> contributing_of(const Balls& balls, Monitor& monitor) {
  std::vector<double> weights(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) weights[i] = weight_of(balls, i);
  PartMonitor first(monitor, 0, 0.6);
  const RegularCells cells = regular_cells(balls.centers, weights, first);
  // The cells around every ball, one after the other.
  std::vector<std::size_t> begins(balls.size() + 1);
  Lookout look(monitor);
  for (const auto& cell : cells.cells) {
    look(8);
    for (const std::int32_t v : cell) begins[v < 0 ? 0 : at(v) + 1] += v >= 0;
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<std::int32_t> around(begins.back());
  std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    look(16);
    for (const std::int32_t v : cells.cells[c]) {
      if (v >= 0) around[next[at(v)]++] = static_cast<std::int32_t>(c);
    }
  }
  ContributionTest test;
  std::vector<Site> link;
  std::vector<std::int32_t> seen_from(balls.size(), -1), found;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (i % 1024 == 0) monitor.step(0.6 + 0.4 * static_cast<double>(i) / static_cast<double>(balls.size()));
    if (begins[i] == begins[i + 1]) continue;  // hidden
    const auto id = static_cast<std::int32_t>(i);
    link.clear();
    for (std::size_t k = begins[i]; k < begins[i + 1]; ++k) {
      for (const std::int32_t v : cells.cells[at(around[k])]) {
        if (v < 0 || v == id || seen_from[at(v)] == id) continue;
        seen_from[at(v)] = id;
        link.push_back({balls.centers[at(v)], weights[at(v)]});
      }
    }
    if (test.contributes({balls.centers[i], weights[i]}, link)) found.push_back(id);
  }
  return found;
}

/// The regular triangulation of balls that contribute, from which some are removed. Every ball has a cell
/// with volume (of discs: area), and cells only grow when others go: none is ever hidden.
class Pruning {
 public:
  Pruning(const Balls& balls, Monitor& monitor) : balls_(balls), vertices_(balls.size()) {
    const std::vector<std::int32_t> order = spatial_order(balls.centers);
    Cell hint;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i % 1024 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(order.size()));
      const Vertex vertex = triangulation_.insert(weighted(at(order[i])), hint);
      vertex->info() = order[i];
      vertices_[at(order[i])] = vertex;
      hint = vertex->cell();
    }
  }

  int dimension() const { return triangulation_.dimension(); }

  /// The cell of the ball reaches out of the union.
  bool reaches_out(std::size_t ball) {
    find_star(ball);
    return std::any_of(star_.begin(), star_.end(), [this](Cell cell) { return !inside(cell); });
  }

  /// The others cover the ball, whose cell does not reach out of the union; after reaches_out.
  bool is_covered(std::size_t ball) {
    link_.clear();
    for (const Cell cell : star_) {
      for (int k = 0; k <= dimension(); ++k) {
        const std::int32_t v = cell->vertex(k)->info();
        if (at(v) != ball) link_.push_back(v);
      }
    }
    std::sort(link_.begin(), link_.end());
    link_.erase(std::unique(link_.begin(), link_.end()), link_.end());
    // What cells the others have in that of the ball is a matter of its neighbors alone.
    rest_.clear();
    Cell hint;
    for (const std::int32_t v : link_) {
      const Vertex vertex = rest_.insert(weighted(at(v)), hint);
      if (vertex != Vertex()) hint = vertex->cell();
    }
    const WeightedPoint site = weighted(ball);
    auto& cells = rest_.tds().cells();
    for (auto cell = cells.begin(); cell != cells.end(); ++cell) {
      if (is_finite(rest_, cell) && !orthocenter_inside(cell) && conflicts(cell, site)) return false;
    }
    return true;
  }

  void remove(std::size_t ball) { triangulation_.remove(vertices_[ball]); }

 private:
  WeightedPoint weighted(std::size_t ball) const {
    const Vec3 c = balls_.centers[ball];
    return {Kernel::Point_3(c.x, c.y, c.z), weight_of(balls_, ball)};
  }

  void find_star(std::size_t ball) {
    star_.clear();
    const Vertex v = vertices_[ball];
    if (dimension() == 3) {
      triangulation_.incident_cells(v, std::back_inserter(star_));
    } else {
      Cell cell = v->cell();
      do {
        star_.push_back(cell);
        cell = cell->neighbor((cell->index(v) + 1) % 3);
      } while (cell != v->cell());
    }
  }

  bool inside(Cell cell) {
    Place& place = cell->info().place;
    if (place == Place::unknown) {
      place = is_finite(triangulation_, cell) && orthocenter_inside(cell) ? Place::inside : Place::outside;
    }
    return place == Place::inside;
  }

  bool is_finite(const Triangulation& of, Cell cell) const {
    for (int k = 0; k <= dimension(); ++k) {
      if (of.is_infinite(cell->vertex(k))) return false;
    }
    return true;
  }

  /// The power of the orthocenter of a finite cell to its vertices is <= 0.
  bool orthocenter_inside(Cell cell) const {
    const auto compare = Kernel().compare_weighted_squared_radius_3_object();
    const auto p = [cell](int k) -> const WeightedPoint& { return cell->vertex(k)->point(); };
    return (dimension() == 3 ? compare(p(0), p(1), p(2), p(3), 0.0) : compare(p(0), p(1), p(2), 0.0)) !=
           CGAL::LARGER;
  }

  /// The power of the orthocenter of the cell to the site is smaller than to its vertices.
  bool conflicts(Cell cell, const WeightedPoint& site) const {
    const auto side =
        dimension() == 3 ? rest_.side_of_power_sphere(cell, site) : rest_.side_of_power_circle(cell, 3, site);
    return side == CGAL::ON_BOUNDED_SIDE;
  }

  const Balls& balls_;
  Triangulation triangulation_, rest_;
  std::vector<Vertex> vertices_;
  std::vector<Cell> star_;
  std::vector<std::int32_t> link_;
};

MinimalUnion all_of(std::size_t count) {
  MinimalUnion all;
  all.kept.resize(count);
  std::iota(all.kept.begin(), all.kept.end(), 0);
  all.contributing = all.touching_boundary = static_cast<std::int64_t>(count);
  return all;
}

}  // namespace

MinimalUnion minimal_of_contributing(const Balls& balls, const MinimalUnionOptions& options,
                                     Monitor& monitor) {
  index_of(balls.size(), "balls of a union");
  PartMonitor begin(monitor, 0, 0.1);
  Pruning pruning(balls, begin);
  // Where the centers span less than the space no cell is bounded, and every ball reaches out of the others.
  const int whole = options.of == UnionOf::balls ? 3 : 2;
  if (pruning.dimension() < whole) return all_of(balls.size());
  MinimalUnion result;
  result.contributing = static_cast<std::int64_t>(balls.size());
  std::vector<std::int32_t> asked;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (i % 1024 == 0) monitor.step(0.1 + 0.1 * static_cast<double>(i) / static_cast<double>(balls.size()));
    (pruning.reaches_out(i) ? result.kept : asked).push_back(static_cast<std::int32_t>(i));
  }
  result.touching_boundary = static_cast<std::int64_t>(result.kept.size());
  std::sort(asked.begin(), asked.end(), [&balls](std::int32_t a, std::int32_t b) {
    return std::tuple(balls.radii[at(a)], balls.centers[at(a)]) <
           std::tuple(balls.radii[at(b)], balls.centers[at(b)]);
  });
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (i % 64 == 0) monitor.step(0.2 + 0.8 * static_cast<double>(i) / static_cast<double>(asked.size()));
    if (!pruning.reaches_out(at(asked[i])) && pruning.is_covered(at(asked[i]))) {
      pruning.remove(at(asked[i]));
    } else {
      result.kept.push_back(asked[i]);
    }
  }
  std::sort(result.kept.begin(), result.kept.end());
  return result;
}

MinimalUnion minimal_union(const Balls& balls, const MinimalUnionOptions& options, Monitor& monitor) {
  if (options.of == UnionOf::discs) {
    require_discs(balls, "balls", "of = balls");
  } else {
    require_usable(balls, "balls");
  }
  if (balls.size() == 0) return {};
  PartMonitor begin(monitor, 0, 0.3);
  const std::vector<std::int32_t> contributing = contributing_of(balls, begin);
  PartMonitor rest(monitor, 0.3, 1);
  MinimalUnion result = minimal_of_contributing(select(balls, contributing), options, rest);
  for (std::int32_t& id : result.kept) id = contributing[at(id)];
  return result;
}

}  // namespace ballflow::geometry
