#include "minkowski/power_triangulation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <utility>

#include "base/index.hpp"
#include "base/space_order.hpp"
#include "power/contribution.hpp"

namespace ballflow::geometry {
namespace {

struct Info {
  double radius = 0;
  std::int32_t id = 0;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<Info, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Regular_triangulation_cell_base_3<Kernel, CGAL::Triangulation_cell_base_3<Kernel>,
                                                         CGAL::Discard_hidden_points>;
// Sequential: parallel insertion of weighted points has data races in CGAL 5.5.
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase, CGAL::Sequential_tag>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, Structure>;
using WeightedPoint = Kernel::Weighted_point_3;
using Cell = std::array<std::int32_t, 4>;

constexpr std::int32_t none = -1;  // the vertex at infinity, or no vertex in flat triangulations

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

WeightedPoint weighted(const Site& site) {
  return {Kernel::Point_3(site.center.x, site.center.y, site.center.z), site.weight};
}
Site site_of(const Ball& ball) { return {ball.center, ball.radius * ball.radius}; }
Site site_of(const WeightedPoint& p) { return {{p.x(), p.y(), p.z()}, p.weight()}; }

/// Some random balls first, then eight times as many, and so on (Amenta, Choi and Rote 2003), each lot along
/// a curve in space, and of those close to each other the larger ones first, which hide others. The random
/// numbers are a function of the coordinates.
std::vector<Ball> in_insertion_order(const std::vector<Ball>& balls, Monitor& monitor) {
  Box box;
  double largest = 0;
  for (const Ball& ball : balls) {
    box.add(ball.center);
    largest = std::max(largest, ball.radius);
  }
  const SpaceOrder place(box);
  // 3 bits for the lot, 6 for each coordinate, which leaves about 10 balls of large sums together, 11 for the
  // size.
  constexpr std::uint64_t lots = 7;
  Lookout look(monitor);
  std::vector<std::uint64_t> keys(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    look(8);
    const Vec3 c = balls[i].center;
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const double x : {c.x, c.y, c.z}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0xbf58476d1ce4e5b9u;
      hash ^= hash >> 31;
    }
    const auto lot = lots - std::min(static_cast<std::uint64_t>(std::countr_zero(hash)) / 3, lots);
    const auto smallness =
        static_cast<std::uint64_t>(largest > 0 ? (1 - balls[i].radius / largest) * 2047 : 0);
    keys[i] = lot << 61 | place(c) >> 42 << 43 | smallness << 32 | i;
  }
  std::sort(keys.begin(), keys.end(), [&look](std::uint64_t a, std::uint64_t b) {
    look(1);
    return a < b;
  });
  std::vector<Ball> ordered(balls.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    look(8);
    ordered[i] = balls[keys[i] & 0xffffffffu];
  }
  return ordered;
}

/// A triangulation as flat tables.
struct Tables {
  std::vector<Ball> balls;
  std::vector<Site> sites;
  std::vector<Cell> cells;

  Tables(const Triangulation& triangulation, Monitor& monitor) {
    Lookout look(monitor);
    balls.reserve(triangulation.number_of_vertices());
    sites.reserve(triangulation.number_of_vertices());
    triangulation.infinite_vertex()->info().id = none;
    for (const auto vertex : triangulation.finite_vertex_handles()) {
      look(16);
      vertex->info().id = index_of(sites.size(), "vertices of the triangulation of the sums");
      sites.push_back(site_of(vertex->point()));
      balls.push_back({sites.back().center, vertex->info().radius});
    }
    const auto& all = triangulation.tds().cells();
    index_of(all.size(), "cells of the triangulation of the sums");
    cells.reserve(all.size());
    for (auto cell = all.begin(); cell != all.end(); ++cell) {
      look(16);
      cells.push_back({none, none, none, none});
      for (int i = 0; i <= triangulation.dimension(); ++i) cells.back()[at(i)] = cell->vertex(i)->info().id;
    }
  }
};

/// The cells around every vertex.
class Stars {
 public:
  Stars(const Tables& tables, Monitor& monitor) : begins_(tables.sites.size() + 1) {
    Lookout look(monitor);
    for (const Cell& cell : tables.cells) {
      look(8);
      for (const std::int32_t v : cell) begins_[at(v + 1)] += v != none;
    }
    begins_[0] = 0;
    for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
    cells_.resize(begins_.back());
    std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
    for (std::size_t c = 0; c < tables.cells.size(); ++c) {
      look(16);
      for (const std::int32_t v : tables.cells[c]) {
        if (v != none) cells_[next[at(v)]++] = static_cast<std::int32_t>(c);
      }
    }
  }
  std::span<const std::int32_t> of(std::size_t vertex) const {
    return {cells_.data() + begins_[vertex], begins_[vertex + 1] - begins_[vertex]};
  }

 private:
  std::vector<std::size_t> begins_;
  std::vector<std::int32_t> cells_;
};

/// How many of the vertices that contribute have a piece of their sphere on the boundary of the union: the
/// power cell, a convex polytope that meets the ball, has a vertex outside it, or none at infinity.
std::int64_t count_touching(const Tables& tables, const std::vector<std::uint8_t>& contributes,
                            Monitor& monitor) {
  const auto compare = Kernel().compare_weighted_squared_radius_3_object();
  const auto point = [&tables](std::int32_t v) { return weighted(tables.sites[at(v)]); };
  std::vector<std::uint8_t> open = contributes;  // 1: contributes, not known to touch
  std::int64_t count = 0;
  Lookout look(monitor);
  for (const Cell& cell : tables.cells) {
    look(16);
    if (std::none_of(cell.begin(), cell.end(),
                     [&open](std::int32_t v) { return v != none && open[at(v)]; })) {
      continue;
    }
    const bool infinite = std::find(cell.begin(), cell.end(), none) != cell.end();
    if (!infinite &&
        compare(point(cell[0]), point(cell[1]), point(cell[2]), point(cell[3]), 0.0) != CGAL::LARGER) {
      continue;
    }
    for (const std::int32_t v : cell) {
      if (v == none) continue;
      count += open[at(v)];
      open[at(v)] = 0;
    }
  }
  return count;
}

}  // namespace

struct PowerTriangulation::Implementation {
  Triangulation triangulation;
  Triangulation::Cell_handle hint;
  ContributionTest test;
  std::vector<Triangulation::Vertex_handle> border;
  std::vector<Site> link;

  struct Place {
    Triangulation::Cell_handle cell;
    Triangulation::Locate_type type = Triangulation::OUTSIDE_AFFINE_HULL;
    int i = 0, j = 0;
  };
  Place locate(const WeightedPoint& point) const {
    Place place;
    place.cell = triangulation.locate(point, place.type, place.i, place.j, hint);
    return place;
  }
  void insert(const WeightedPoint& point, double radius, const Place& place) {
    const auto vertex = triangulation.insert(point, place.type, place.cell, place.i, place.j);
    if (vertex == Triangulation::Vertex_handle()) {
      hint = place.cell;  // hidden
    } else {
      vertex->info().radius = radius;
      hint = vertex->cell();
    }
  }
};

PowerTriangulation::PowerTriangulation() : implementation_(std::make_unique<Implementation>()) {}
PowerTriangulation::~PowerTriangulation() = default;

std::size_t PowerTriangulation::vertices() const {
  return implementation_->triangulation.number_of_vertices();
}

void PowerTriangulation::insert(std::vector<Ball> balls, Monitor& monitor) {
  balls = in_insertion_order(balls, monitor);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (i % 1024 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(balls.size()));
    const WeightedPoint point = weighted(site_of(balls[i]));
    implementation_->insert(point, balls[i].radius, implementation_->locate(point));
  }
}

void PowerTriangulation::insert_if_contributing(const Ball& ball) {
  Implementation& my = *implementation_;
  const WeightedPoint point = weighted(site_of(ball));
  const auto place = my.locate(point);
  if (my.triangulation.dimension() == 3 && place.type != Triangulation::VERTEX) {
    // Its neighbours would be the vertices around the cells that it would destroy; a hidden point has none.
    my.border.clear();
    my.triangulation.vertices_on_conflict_zone_boundary(point, place.cell, std::back_inserter(my.border));
    my.link.clear();
    for (const auto vertex : my.border) {
      if (!my.triangulation.is_infinite(vertex)) my.link.push_back(site_of(vertex->point()));
    }
    if (my.border.empty() || !my.test.contributes(site_of(ball), my.link)) {
      my.hint = place.cell;
      return;
    }
  }
  my.insert(point, ball.radius, place);
}

void PowerTriangulation::insert(const Ball& ball) {
  const WeightedPoint point = weighted(site_of(ball));
  implementation_->insert(point, ball.radius, implementation_->locate(point));
}

bool PowerTriangulation::may_contribute(const Ball& ball) {
  Implementation& my = *implementation_;
  if (my.triangulation.dimension() < 3) return true;
  const WeightedPoint point = weighted(site_of(ball));
  const auto place = my.locate(point);
  my.hint = place.cell;
  // Most are quickly seen: one ball of those around contains it, or its center is in its own cell as far as
  // these can tell, which only costs a look at what is in it.
  bool center_free = true;
  for (int i = 0; i < 4; ++i) {
    const auto vertex = place.cell->vertex(i);
    if (my.triangulation.is_infinite(vertex)) return true;
    const double d = distance(site_of(vertex->point()).center, ball.center), r = vertex->info().radius;
    const double room = (r - ball.radius) - 0x1p-40 * r;
    if (room > 0 && d < room) return false;
    center_free = center_free && d * d - r * r > -ball.radius * ball.radius;
  }
  if (center_free) return true;
  my.border.clear();
  if (place.type != Triangulation::VERTEX)
    my.triangulation.vertices_on_conflict_zone_boundary(point, place.cell, std::back_inserter(my.border));
  if (my.border.empty()) return place.type == Triangulation::VERTEX;
  my.link.clear();
  for (const auto vertex : my.border) {
    if (!my.triangulation.is_infinite(vertex)) my.link.push_back(site_of(vertex->point()));
  }
  return my.test.contributes(site_of(ball), my.link);
}

Contributing PowerTriangulation::contributing(Monitor& monitor) {
  return contributing([](const Ball&) { return Share::whole; }, monitor);
}

Shared PowerTriangulation::contributing(const std::function<Share(const Ball&)>& share, Monitor& monitor) {
  const Tables tables(implementation_->triangulation, monitor);
  implementation_->triangulation.clear();
  const Stars stars(tables, monitor);
  ContributionTest& test = implementation_->test;
  std::vector<Site>& link = implementation_->link;
  std::vector<std::int32_t> seen_from(tables.sites.size(), none), around;
  std::vector<std::uint8_t> contributes(tables.sites.size());
  Shared result;
  for (std::size_t i = 0; i < tables.sites.size(); ++i) {
    if (i % 1024 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(tables.sites.size()));
    const Share wanted = share(tables.balls[i]);
    if (wanted == Share::none) continue;
    const auto id = static_cast<std::int32_t>(i);
    link.clear();
    around.clear();
    for (const std::int32_t cell : stars.of(i)) {
      for (const std::int32_t v : tables.cells[at(cell)]) {
        if (v == none || v == id || seen_from[at(v)] == id) continue;
        seen_from[at(v)] = id;
        link.push_back(tables.sites[at(v)]);
        around.push_back(v);
      }
    }
    if (!test.contributes(tables.sites[i], link)) continue;
    if (wanted == Share::whole) {
      contributes[i] = 1;
      result.balls.push_back(tables.balls[i]);
      continue;
    }
    result.parts.push_back(tables.balls[i]);
    for (const std::int32_t v : around) result.around.push_back(tables.balls[at(v)]);
    result.around_offsets.push_back(result.around.size());
  }
  result.touching_boundary = count_touching(tables, contributes, monitor);
  return result;
}

}  // namespace ballflow::geometry
