#include "axis/voronoi_places.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "exact/circumcenter.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Place = VoronoiVertex::Place;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
Kernel::Point_3 point(Vec3 p) { return {p.x, p.y, p.z}; }

}  // namespace

bool VoronoiPlaces::all_on(std::int32_t ball, std::span<const std::int32_t> sites) const {
  return std::all_of(sites.begin(), sites.end(), [&](std::int32_t w) {
    const auto all = sites_.balls_of(at(w));
    return std::find(all.begin(), all.end(), ball) != all.end();
  });
}

/// The smallest ball with all the given sites on its sphere, -1 when there is none.
std::int32_t VoronoiPlaces::common_ball(std::span<const std::int32_t> sites) const {
  for (const std::int32_t ball : sites_.balls_of(at(sites[0]))) {
    if (all_on(ball, sites.subspan(1))) return ball;
  }
  return -1;
}

// --- Rounded places.

RoundedPlaces::RoundedPlaces(const SimplicialComplex& complex, UnionVertices sites, double size,
                             Monitor& monitor)
    : VoronoiPlaces(complex), size_(size), same_(std::ldexp(size, -36)) {
  sites_ = std::move(sites);
  PartMonitor triangulating(monitor, 0, 0.8);
  cells_ = delaunay_cells(sites_.points, triangulating);
  place_cells(monitor);
  merge_coincident(monitor);
}

Place RoundedPlaces::place_of_centroid(std::int32_t w0, std::int32_t w1,
                                       std::span<const std::int32_t> balls) const {
  Vec3 sum;
  for (const std::int32_t ball : balls) sum = sum + center(ball);
  const Vec3 x = (1.0 / static_cast<double>(balls.size())) * sum;
  const double d0 = depth(w0, x), d1 = depth(w1, x);
  const double clearest = std::abs(d0) > std::abs(d1) ? d0 : d1;  // the site that sees x more clearly decides
  return clearest > same_ ? Place::in : clearest < -same_ ? Place::out : Place::on;
}

bool RoundedPlaces::nearer(std::int32_t a, std::int32_t b, std::int32_t cell) const {
  const VoronoiVertex& v = vertex(cell);
  const Vec3 from = v.place == Place::on ? center(v.name) : position(cell);
  const double da = squared_distance(center(a), from), db = squared_distance(center(b), from);
  return da != db ? da < db : a < b;
}

/// How deep x, a point of the cell of w, lies in R as seen from w: positive inside, negative outside.
double RoundedPlaces::depth(std::int32_t w, Vec3 x) const {
  const auto plane = [&](const UnionVertices::Face& face) {
    const auto& t = complex_.triangles[at(face.triangle)];
    const Vec3 a = center(t[0]), b = center(t[1]), c = center(t[2]);
    const double side = -face.outside * CGAL::orientation(point(a), point(b), point(c), point(x));
    const Vec3 n = cross(b - a, c - a);
    const double size = length(n);
    return size > 0 ? side * std::abs(dot(n, x - a)) / size : 0.0;  // 0: too thin for doubles
  };
  const auto faces = sites_.faces_of(at(w));
  if (faces.size() == 1) return plane(faces[0]);
  // Several triangles: x is inside when the segment from w to x passes through one of them. The segment
  // starts a little outside, because w itself may lie on an edge of its triangles (where balls touch).
  double best = -std::numeric_limits<double>::infinity();
  Vec3 outward;
  for (const auto& face : faces) {
    const auto& t = complex_.triangles[at(face.triangle)];
    const Vec3 a = center(t[0]), n = cross(center(t[1]) - a, center(t[2]) - a);
    const double size = length(n);
    if (size > 0) outward = outward + (face.outside / size) * n;
  }
  const Kernel::Point_3 from = point(sites_.points[at(w)] + std::ldexp(size_, -26) * outward), to = point(x);
  for (const auto& face : faces) {
    const auto& t = complex_.triangles[at(face.triangle)];
    double inside = plane(face);
    bool left = false, right = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto turn = CGAL::orientation(from, to, point(center(t[k])), point(center(t[(k + 1) % 3])));
      left = left || turn == CGAL::LEFT_TURN;
      right = right || turn == CGAL::RIGHT_TURN;
    }
    if (left && right) inside = -std::abs(inside);
    best = std::max(best, inside);
  }
  return best;
}

void RoundedPlaces::place_cells(Monitor& monitor) {
  vertices_.resize(cells_.size());
  positions_.resize(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (i % 256 == 0) monitor.step(0.8 + 0.2 * static_cast<double>(i) / static_cast<double>(cells_.size()));
    const DelaunayCell& cell = cells_[i];
    VoronoiVertex& v = vertices_[i];
    v = {Place::out, balls() + static_cast<std::int32_t>(i)};
    if (!cell.finite()) continue;
    const std::int32_t ball = common_ball(cell.corners);
    if (ball >= 0) {
      v = {Place::on, ball};
      continue;
    }
    std::array<Vec3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = sites_.points[at(cell.corners[k])];
    std::sort(corners.begin(), corners.end(), before);
    positions_[i] = circumcenter(corners);
    const Vec3 x = positions_[i];
    if (!is_finite(x)) continue;  // four sites all but in a plane: far outside
    // A sphere may pass through a site that does not carry its name.
    for (const std::int32_t w : cell.corners) {
      for (const std::int32_t b : sites_.balls_of(at(w))) {
        if (squared_distance(x, center(b)) <= same_ * same_) v = {Place::on, b};
      }
    }
    if (v.place == Place::on) continue;
    const bool singular = std::any_of(cell.corners.begin(), cell.corners.end(),
                                      [&](std::int32_t w) { return sites_.faces_of(at(w)).empty(); });
    if (singular) continue;
    // All sites of the cell agree but for rounding; the clearest voice decides.
    double clearest = 0;
    for (const std::int32_t w : cell.corners) {
      const double d = depth(w, x);
      if (std::abs(d) > std::abs(clearest)) clearest = d;
    }
    if (clearest > 0) v.place = Place::in;
  }
}

/// Gives neighbouring cells inside R with one circumcentre one name: five and more sites on a sphere, as
/// symmetric unions have. What lies between them are Voronoi edges and facets without length and area.
void RoundedPlaces::merge_coincident(Monitor& monitor) {
  const std::int32_t first = balls();
  const auto name_of = [&](std::int32_t cell) {
    while (vertices_[at(cell)].name != first + cell) {
      std::int32_t& name = vertices_[at(cell)].name;
      name = vertices_[at(name - first)].name;
      cell = name - first;
    }
    return cell;
  };
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(cells_.size()); ++i) {
    if (i % 1024 == 0) monitor.step(1);
    if (vertices_[at(i)].place != Place::in) continue;
    for (const std::int32_t j : cells_[at(i)].neighbors) {
      if (j >= i || vertices_[at(j)].place != Place::in) continue;
      if (squared_distance(positions_[at(i)], positions_[at(j)]) > same_ * same_) continue;
      const std::int32_t a = name_of(i), b = name_of(j);
      vertices_[at(std::max(a, b))].name = first + std::min(a, b);
    }
  }
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(cells_.size()); ++i) {
    if (vertices_[at(i)].place == Place::in) vertices_[at(i)].name = first + name_of(i);
  }
}
// --- Grown places.

GrownPlaces::GrownPlaces(const SimplicialComplex& complex, const GrownSites& sites, double size,
                         Monitor& monitor)
    : VoronoiPlaces(complex), grown_(sites), size_(size) {
  PartMonitor triangulating(monitor, 0.3, 0.6), placing(monitor, 0.6, 0.7);
  sites_ = sites.table();
  cells_ = sites.delaunay(triangulating);
  vertices_.resize(cells_.size());
  positions_.resize(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (i % 64 == 0) placing.step(static_cast<double>(i) / static_cast<double>(cells_.size()));
    const DelaunayCell& cell = cells_[i];
    VoronoiVertex& v = vertices_[i];
    v = {Place::out, balls() + static_cast<std::int32_t>(i)};
    if (!cell.finite() || sites_.faces_of(at(cell.corners[3])).empty())
      continue;  // the points around all come last
    const std::int32_t ball = common_ball(cell.corners);
    if (ball >= 0) {
      v = {Place::on, ball};
      continue;
    }
    // All four sites agree.
    if (grown_.side_of_circumcenter(cell.corners[0], cell.corners) < 0) continue;
    v.place = Place::in;
    positions_[i] = grown_.circumcenter(cell.corners);
  }
}

Place GrownPlaces::place_of_centroid(std::int32_t w0, std::int32_t w1,
                                     std::span<const std::int32_t> balls) const {
  int side = grown_.side_of_centroid(w0, balls);
  if (side == 0) side = grown_.side_of_centroid(w1, balls);
  return side > 0 ? Place::in : side < 0 ? Place::out : Place::on;
}

bool GrownPlaces::nearer(std::int32_t a, std::int32_t b, std::int32_t cell) const {
  const VoronoiVertex& v = vertex(cell);
  if (v.place != Place::on) return grown_.nearer(a, b, cells_[at(cell)].corners);
  const double da = squared_distance(center(a), center(v.name)),
               db = squared_distance(center(b), center(v.name));
  return da != db ? da < db : a < b;
}

bool GrownPlaces::coincide(std::int32_t w0, std::int32_t w1) const {
  return distance(sites_.points[at(w0)], sites_.points[at(w1)]) <= std::ldexp(size_, -40);
}

}  // namespace ballflow::geometry
