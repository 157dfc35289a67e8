#include "power/voids.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace ballflow::geometry {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Exact::Point_3;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Point exact(Vec3 p) { return {p.x, p.y, p.z}; }

/// The point that has equal power to four balls.
Point equal_power(const SimplicialComplex& complex, const Voids::Cell& cell) {
  const auto ball = [&](std::size_t k) {
    return Exact::Weighted_point_3(exact(complex.centers[at(cell[k])]), complex.weights[at(cell[k])]);
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

Voids::Voids(const SimplicialComplex& complex, const RegularCells& cells, Monitor& monitor)
    : complex_(complex), cells_(cells) {
  cells_of_.resize(1);
  if (cells.dimension < 3) return;
  Lookout look(monitor);
  const auto has = [](const auto& list, const auto& simplex) {
    return std::binary_search(list.begin(), list.end(), simplex);
  };
  const std::size_t n = cells.size();
  std::vector<bool> in_complex(n);
  for (std::size_t c = 0; c < n; ++c) {
    look(32);
    in_complex[c] = finite(cells.cells[c]) && has(complex.tetrahedra, sorted(cells.cells[c]));
  }
  // Flood every void from its first cell.
  label_.assign(n, -1);
  std::vector<std::vector<std::size_t>> members;
  std::vector<std::size_t> queue;
  std::size_t outside = 0;
  for (std::size_t start = 0; start < n; ++start) {
    if (in_complex[start] || label_[start] >= 0) continue;
    const auto label = static_cast<std::int32_t>(members.size());
    label_[start] = label;
    queue.assign(1, start);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::size_t c = queue[i];
      look(128);
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = at(cells.neighbors[c][k]);
        if (in_complex[next] || label_[next] >= 0 || !open(c, k)) continue;
        label_[next] = label;
        queue.push_back(next);
      }
    }
    if (std::any_of(queue.begin(), queue.end(), [&](std::size_t c) { return !finite(cells.cells[c]); })) {
      outside = members.size();
    }
    members.push_back(queue);
  }
  // Number them by their smallest cells: the order of the cells of a triangulation means nothing.
  std::vector<std::pair<std::vector<Cell>, std::int32_t>> inner;
  for (std::size_t m = 0; m < members.size(); ++m) {
    std::vector<Cell> list;
    for (const std::size_t c : members[m]) {
      if (finite(cells.cells[c])) list.push_back(sorted(cells.cells[c]));
    }
    std::sort(list.begin(), list.end());
    if (m == outside) {
      cells_of_[0] = std::move(list);
    } else {
      inner.emplace_back(std::move(list), static_cast<std::int32_t>(m));
    }
  }
  std::sort(inner.begin(), inner.end(), [](const auto& a, const auto& b) { return a.first[0] < b.first[0]; });
  std::vector<std::int32_t> number(members.size(), outer);
  for (auto& [list, label] : inner) {
    number[at(label)] = count();
    cells_of_.push_back(std::move(list));
  }
  for (std::int32_t& label : label_) {
    if (label >= 0) label = number[at(label)];
  }
}

bool Voids::open(std::size_t c, std::size_t k) const {
  const Cell& cell = cells_.cells[c];
  std::array<std::int32_t, 3> facet{cell[(k + 1) & 3], cell[(k + 2) & 3], cell[(k + 3) & 3]};
  std::sort(facet.begin(), facet.end());
  return facet[0] < 0 || !std::binary_search(complex_.triangles.begin(), complex_.triangles.end(), facet);
}

std::vector<Voids::Place> Voids::inside(const Voids& other) const {
  std::vector<Place> result{{outer, Place::outside}};
  for (std::int32_t v = 1; v < count(); ++v) result.push_back(located(cells_of(v).front(), other));
  return result;
}

std::vector<Voids::Cell> Voids::between(const Place& a, const Place& b) const {
  if (a.cell == Place::outside) return b.cell == Place::outside ? std::vector<Cell>() : between(b, a);
  // Layer by layer from a; each layer in the order of its corners, since that of cells means nothing.
  std::vector<std::int32_t> before(cells_.size(), -1);
  std::vector<std::int32_t> layer{a.cell}, next;
  before[at(a.cell)] = a.cell;
  const auto arrived = [&](std::int32_t c) {
    return b.cell == Place::outside ? !finite(cells_.cells[at(c)]) : c == b.cell;
  };
  while (!layer.empty()) {
    std::sort(layer.begin(), layer.end(), [this](std::int32_t c, std::int32_t d) {
      return sorted(cells_.cells[at(c)]) < sorted(cells_.cells[at(d)]);
    });
    next.clear();
    for (const std::int32_t c : layer) {
      if (arrived(c)) {
        std::vector<Cell> way;
        for (std::int32_t step = c;; step = before[at(step)]) {
          if (finite(cells_.cells[at(step)])) way.push_back(sorted(cells_.cells[at(step)]));
          if (step == a.cell) return way;
        }
      }
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t n = cells_.neighbors[at(c)][k];
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
  const Point point = equal_power(complex_, orthogonal_to);
  const auto corner = [&](std::int32_t v) { return exact(other.complex_.centers[at(v)]); };
  // Walk through facets that separate the cell from the point; regular triangulations have no circles.
  std::size_t c = 0;
  while (!finite(other.cells_.cells[c])) ++c;
  for (;;) {
    const Cell& cell = other.cells_.cells[c];
    if (!finite(cell)) return {};
    const Point p[4] = {corner(cell[0]), corner(cell[1]), corner(cell[2]), corner(cell[3])};
    std::size_t k = 0;
    for (; k < 4; ++k) {
      Point q[4] = {p[0], p[1], p[2], p[3]};
      q[k] = point;
      if (CGAL::orientation(q[0], q[1], q[2], q[3]) == CGAL::NEGATIVE) break;
    }
    if (k == 4) break;
    c = at(other.cells_.neighbors[c][k]);
  }
  if (other.label_[c] < 0)
    throw std::logic_error("a point outside of a union of balls lies in its dual complex");
  return {other.label_[c], static_cast<std::int32_t>(c)};
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
