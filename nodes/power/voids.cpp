#include "power/voids.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace ballflow::geometry {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Exact::Point_3;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Point exact(Vec3 p) { return {p.x, p.y, p.z}; }

/// The point that has equal power to four balls.
Point equal_power(const PowerDiagram& diagram, const Voids::Cell& cell) {
  const auto ball = [&](std::size_t k) {
    return Exact::Weighted_point_3(exact(diagram.centers[at(cell[k])]), diagram.weights[at(cell[k])]);
  };
  return Exact().construct_weighted_circumcenter_3_object()(ball(0), ball(1), ball(2), ball(3));
}

bool finite(const Voids::Cell& cell) {
  return std::none_of(cell.begin(), cell.end(), [](std::int32_t v) { return v < 0; });
}

Voids::Cell sorted(Voids::Cell cell) {
  std::sort(cell.begin(), cell.end());
  return cell;
}

}  // namespace

Voids::Voids(const PowerDiagram& diagram, Monitor& monitor) : diagram_(diagram) {
  if (diagram.dimension < 3) {
    cells_of_.resize(1);
    return;
  }
  // Flood every void from its first cell. Infinite cells come first, so that the outer one has number 0, and
  // the others follow in the order of the cells.
  Lookout look(monitor);
  label_.assign(diagram.size(), -1);
  std::vector<std::size_t> queue;
  std::int32_t labels = 0;
  for (std::size_t start = 0; start < diagram.size(); ++start) {
    if (label_[start] >= 0 || (diagram.in_complex[start] & PowerDiagram::whole) != 0) continue;
    const std::int32_t label = labels++;
    label_[start] = label;
    queue.assign(1, start);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::size_t c = queue[i];
      look(32);
      for (std::size_t k = 0; k < 4; ++k) {
        if (!open(c, k)) continue;  // cells in K have no open facet
        const std::size_t next = at(diagram.neighbors[c][k]);
        if (label_[next] >= 0) continue;
        label_[next] = label;
        queue.push_back(next);
      }
    }
  }
  cells_of_.resize(at(labels));
  for (std::size_t c = 0; c < diagram.size(); ++c) {
    look(8);
    if (label_[c] >= 0 && finite(diagram.cells[c]))
      cells_of_[at(label_[c])].push_back(sorted(diagram.cells[c]));
  }
}

std::vector<Voids::Place> Voids::inside(const Voids& other) const {
  std::vector<Place> result{{outer, Place::outside}};
  for (std::int32_t v = 1; v < count(); ++v) result.push_back(located(cells_of(v).front(), other));
  return result;
}

std::vector<Voids::Cell> Voids::between(const Place& a, const Place& b) const {
  if (a.cell == Place::outside) return b.cell == Place::outside ? std::vector<Cell>() : between(b, a);
  // Layer by layer from a; each layer in the order of its corners, since that of cells means nothing.
  std::vector<std::int32_t> before(diagram_.size(), -1);
  std::vector<std::int32_t> layer{a.cell}, next;
  before[at(a.cell)] = a.cell;
  const auto arrived = [&](std::int32_t c) {
    return b.cell == Place::outside ? !finite(diagram_.cells[at(c)]) : c == b.cell;
  };
  while (!layer.empty()) {
    std::sort(layer.begin(), layer.end(), [this](std::int32_t c, std::int32_t d) {
      return sorted(diagram_.cells[at(c)]) < sorted(diagram_.cells[at(d)]);
    });
    next.clear();
    for (const std::int32_t c : layer) {
      if (arrived(c)) {
        std::vector<Cell> way;
        for (std::int32_t step = c;; step = before[at(step)]) {
          if (finite(diagram_.cells[at(step)])) way.push_back(sorted(diagram_.cells[at(step)]));
          if (step == a.cell) return way;
        }
      }
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t n = diagram_.neighbors[at(c)][k];
        if (before[at(n)] >= 0 || label_[at(n)] < 0 || !open(at(c), k)) continue;
        before[at(n)] = c;
        next.push_back(n);
      }
    }
    layer.swap(next);
  }
  throw std::logic_error("two places of one void are not connected");
}

/// A vertex of the power diagram of this union lies outside of it, in the void of its cell, hence outside of
/// `other`, in the void of the cell of the triangulation of `other` that it lies in: the dual complex of
/// `other` lies in the union `other`.
Voids::Place Voids::located(const Cell& orthogonal_to, const Voids& other) const {
  if (other.label_.empty()) return {};
  const Place place = other.diagram_place(equal_power(diagram_, orthogonal_to));
  if (place.number < 0)
    throw std::logic_error("a point outside of a union of balls lies in its dual complex");
  return place;
}

Voids::Place Voids::place_of(Vec3 point) const {
  if (label_.empty()) return {};
  return diagram_place(exact(point));
}

/// Walks through facets that separate the cell from the point; regular triangulations have no circles.
template <class ExactPoint>
Voids::Place Voids::diagram_place(const ExactPoint& point) const {
  const auto corner = [&](std::int32_t v) { return exact(diagram_.centers[at(v)]); };
  std::size_t c = 0;
  while (!finite(diagram_.cells[c])) ++c;
  for (;;) {
    const Cell& cell = diagram_.cells[c];
    if (!finite(cell)) return {};
    const Point p[4] = {corner(cell[0]), corner(cell[1]), corner(cell[2]), corner(cell[3])};
    std::size_t k = 0;
    for (; k < 4; ++k) {
      Point q[4] = {p[0], p[1], p[2], p[3]};
      q[k] = point;
      if (CGAL::orientation(q[0], q[1], q[2], q[3]) == CGAL::NEGATIVE) break;
    }
    if (k == 4) return {label_[c], static_cast<std::int32_t>(c)};
    c = at(diagram_.neighbors[c][k]);
  }
}

PowerVertex power_vertex(const SimplicialComplex& complex, const Voids::Cell& cell) {
  const Vec3 origin = complex.centers[at(cell[0])];
  const double weight = complex.weights[at(cell[0])];
  Vec3 a[3];
  double b[3];
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = complex.centers[at(cell[k + 1])] - origin;
    b[k] = 0.5 * (dot(a[k], a[k]) - complex.weights[at(cell[k + 1])] + weight);
  }
  const Vec3 x = (1 / dot(a[0], cross(a[1], a[2]))) *
                 (b[0] * cross(a[1], a[2]) + b[1] * cross(a[2], a[0]) + b[2] * cross(a[0], a[1]));
  return {origin + x, dot(x, x) - weight};
}

}  // namespace ballflow::geometry
