#include "power/union_vertices.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/disjoint_sets.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(Vec3 p) { return {p.x, p.y, p.z}; }

/// The two points on three spheres: foot + height * normal and foot - height * normal.
struct TriplePoints {
  Vec3 foot;    // orthocentre of the weighted triangle, relative to its first corner
  Vec3 normal;  // cross product of the edges at that corner; not of unit length
  double squared_height = 0;
};

template <class Number>
struct Vector {
  Number x, y, z;
};
template <class Number>
Vector<Number> cross_of(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Number>
Number dot_of(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// With Number = double: false when cancellation may have spoilt the result.
template <class Number>
bool triple_points(const std::array<Vec3, 3>& c, const std::array<double, 3>& w, TriplePoints& out) {
  const auto edge = [&c](std::size_t k) {
    return Vector<Number>{Number(c[k].x) - Number(c[0].x), Number(c[k].y) - Number(c[0].y),
                          Number(c[k].z) - Number(c[0].z)};
  };
  const Vector<Number> a = edge(1), b = edge(2);
  const Number aa = dot_of(a, a), bb = dot_of(b, b);
  const Vector<Number> n = cross_of(a, b);
  const Number nn = dot_of(n, n);
  constexpr bool exact = !std::is_same_v<Number, double>;
  if (!exact && !(nn > Number(1e-4) * aa * bb)) return false;
  // The foot f is n x (something), and f.a = alpha, f.b = beta are the planes of equal power.
  const Number alpha = (aa + Number(w[0]) - Number(w[1])) / Number(2);
  const Number beta = (bb + Number(w[0]) - Number(w[2])) / Number(2);
  const Vector<Number> bn = cross_of(b, n), na = cross_of(n, a);
  const Vector<Number> f{(alpha * bn.x + beta * na.x) / nn, (alpha * bn.y + beta * na.y) / nn,
                         (alpha * bn.z + beta * na.z) / nn};
  const Number ff = dot_of(f, f);
  const Number hh = Number(w[0]) - ff;
  if (!exact && !(hh > Number(1e-3) * Number(w[0]))) return false;
  out.foot = {CGAL::to_double(f.x), CGAL::to_double(f.y), CGAL::to_double(f.z)};
  out.normal = {CGAL::to_double(n.x), CGAL::to_double(n.y), CGAL::to_double(n.z)};
  out.squared_height = std::max(0.0, CGAL::to_double(hh));
  return true;
}

/// The vertex of triangle ijk on the side where orientation(i, j, k, .) is `side`.
Vec3 vertex_of(const SimplicialComplex& complex, std::array<std::int32_t, 3> triangle, int side) {
  for (const std::size_t k : {0, 1, 0}) {
    const auto center = [&](std::size_t i) { return complex.centers[static_cast<std::size_t>(triangle[i])]; };
    if (!before(center(k + 1), center(k))) continue;
    std::swap(triangle[k], triangle[k + 1]);
    side = -side;
  }
  std::array<Vec3, 3> centers;
  std::array<double, 3> weights{};
  for (std::size_t k = 0; k < 3; ++k) {
    centers[k] = complex.centers[static_cast<std::size_t>(triangle[k])];
    weights[k] = complex.weights[static_cast<std::size_t>(triangle[k])];
  }
  TriplePoints p;
  if (!triple_points<double>(centers, weights, p)) triple_points<CGAL::Exact_rational>(centers, weights, p);
  const double nn = squared_length(p.normal);
  const double step = nn > 0 ? side * (std::sqrt(p.squared_height) / std::sqrt(nn)) : 0.0;
  return centers[0] + (p.foot + step * p.normal);
}

/// Groups points that form chains with steps of at most `reach`; the smallest index of a group is its name.
class Chains {
 public:
  Chains(const std::vector<Vec3>& points, double reach, Monitor& monitor)
      : points_(points), reach_(reach), chains_(points.size()), look_(monitor) {
    std::vector<std::int32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0);
    split(std::span(all), 0, 0);
  }
  std::int32_t root(std::int32_t i) { return chains_.root(i); }

 private:
  static double coordinate(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
  const Vec3& at(std::int32_t i) const { return points_[static_cast<std::size_t>(i)]; }

  /// Cuts the range at the gaps along one axis after the other, until no axis has a gap: then it is tiny.
  void split(std::span<std::int32_t> range, int axis, int without_gap) {
    if (range.size() < 2) return;
    if (without_gap == 3) return join(range);
    std::sort(range.begin(), range.end(), [&](std::int32_t a, std::int32_t b) {
      look_(4);
      const double ca = coordinate(at(a), axis), cb = coordinate(at(b), axis);
      return ca != cb ? ca < cb : a < b;
    });
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= range.size(); ++i) {
      if (i < range.size() && coordinate(at(range[i]), axis) - coordinate(at(range[i - 1]), axis) <= reach_)
        continue;
      const bool whole = begin == 0 && i == range.size();
      split(range.subspan(begin, i - begin), (axis + 1) % 3, whole ? without_gap + 1 : 0);
      begin = i;
    }
  }
  void join(std::span<std::int32_t> range) {
    for (std::size_t i = 0; i < range.size(); ++i) {
      look_(range.size() - i);
      for (std::size_t k = i + 1; k < range.size(); ++k) {
        if (squared_distance(at(range[i]), at(range[k])) <= reach_ * reach_) chains_.join(range[i], range[k]);
      }
    }
  }

  const std::vector<Vec3>& points_;
  double reach_;
  DisjointSets chains_;
  Lookout look_;
};

/// `filled`: per triangle, whether a tetrahedron lies on side -1 and on side 1.
std::vector<ExposedSide> names_of(const std::vector<std::array<bool, 2>>& filled) {
  std::vector<ExposedSide> named;
  for (std::size_t i = 0; i < filled.size(); ++i) {
    const bool singular = !filled[i][0] && !filled[i][1];
    for (const std::int8_t side : {std::int8_t{-1}, std::int8_t{1}}) {
      if (!filled[i][side > 0 ? 1 : 0]) named.push_back({static_cast<std::int32_t>(i), side, !singular});
    }
  }
  return named;
}

}  // namespace

std::vector<ExposedSide> exposed_sides(const SimplicialComplex& complex, Monitor& monitor) {
  const std::size_t n = complex.triangles.size();
  std::vector<std::array<bool, 2>> filled(n, {false, false});  // a tetrahedron lies on side -1, +1
  const auto& all = complex.triangles;
  const double total = static_cast<double>(complex.tetrahedra.size());
  std::size_t done = 0;
  for (const auto& t : complex.tetrahedra) {
    if (done++ % 4096 == 0) monitor.step(0.4 * static_cast<double>(done) / total);
    for (std::size_t skip = 0; skip < 4; ++skip) {
      std::array<std::int32_t, 3> face{};
      for (std::size_t k = 0, m = 0; k < 4; ++k) {
        if (k != skip) face[m++] = t[k];
      }
      const auto at = std::lower_bound(all.begin(), all.end(), face);
      const auto center = [&](std::int32_t i) { return point(complex.centers[static_cast<std::size_t>(i)]); };
      const auto side = CGAL::orientation(center(face[0]), center(face[1]), center(face[2]), center(t[skip]));
      filled[static_cast<std::size_t>(at - all.begin())][side == CGAL::POSITIVE ? 1 : 0] = true;
    }
  }
  return names_of(filled);
}

std::vector<ExposedSide> exposed_sides(const SimplicialComplex& complex, const PowerDiagram& diagram,
                                       Monitor& monitor) {
  std::vector<std::array<bool, 2>> filled(complex.triangles.size(), {false, false});
  if (diagram.dimension < 3) return names_of(filled);
  // The facets in the complex, each by its ascending balls once: sorted, they are the triangles of the
  // complex.
  struct Facet {
    std::array<std::int32_t, 3> balls;
    std::array<bool, 2> filled{false, false};
  };
  std::vector<Facet> facets;
  facets.reserve(complex.triangles.size());
  Lookout look(monitor);
  for (std::size_t c = 0; c < diagram.size(); ++c) {
    look(16);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto other = static_cast<std::size_t>(diagram.neighbors[c][k]);
      if (other < c || (diagram.in_complex[c] >> k & 1) == 0) continue;
      // Positively oriented cells: the corner opposite lies on the positive side of the facet as it follows
      // from the others in their order, turned once for every exchange, and for every step that k is before
      // the end.
      const auto& cell = diagram.cells[c];
      Facet facet{{cell[k == 0 ? 1 : 0], cell[k <= 1 ? 2 : 1], cell[k <= 2 ? 3 : 2]}};
      bool positive = k % 2 == 1;
      for (const std::size_t i : {0, 1, 0}) {
        if (facet.balls[i] < facet.balls[i + 1]) continue;
        std::swap(facet.balls[i], facet.balls[i + 1]);
        positive = !positive;
      }
      if ((diagram.in_complex[c] & PowerDiagram::whole) != 0) facet.filled[positive ? 1 : 0] = true;
      if ((diagram.in_complex[other] & PowerDiagram::whole) != 0) facet.filled[positive ? 0 : 1] = true;
      facets.push_back(facet);
    }
  }
  monitor.step(0.2);
  std::sort(facets.begin(), facets.end(), [&look](const Facet& a, const Facet& b) {
    look(2);
    return a.balls < b.balls;
  });
  if (facets.size() != filled.size())
    throw std::logic_error("the power diagram is not the one that the complex was read off");
  for (std::size_t i = 0; i < facets.size(); ++i) filled[i] = facets[i].filled;
  monitor.step(0.4);
  return names_of(filled);
}

Vec3 boundary_vertex(const SimplicialComplex& complex, const ExposedSide& side) {
  return vertex_of(complex, complex.triangles[static_cast<std::size_t>(side.triangle)], side.side);
}

UnionVertices union_vertices(const SimplicialComplex& complex, double merge_distance, Monitor& monitor) {
  return union_vertices(complex, exposed_sides(complex, monitor), merge_distance, monitor);
}

UnionVertices union_vertices(const SimplicialComplex& complex, const std::vector<ExposedSide>& named,
                             double merge_distance, Monitor& monitor) {
  std::vector<Vec3> points;
  points.reserve(named.size());
  for (const ExposedSide& v : named) {
    if (points.size() % 256 == 0)  // a vertex takes 15 us where rational numbers decide
      monitor.step(0.4 + 0.4 * static_cast<double>(points.size()) / static_cast<double>(named.size()));
    points.push_back(boundary_vertex(complex, v));
  }
  Chains chains(points, merge_distance, monitor);
  Lookout look(monitor);
  std::vector<std::pair<std::int32_t, std::int32_t>> members;  // (name of the group, member)
  members.reserve(named.size());
  for (std::size_t i = 0; i < named.size(); ++i) {
    members.emplace_back(chains.root(static_cast<std::int32_t>(i)), static_cast<std::int32_t>(i));
  }
  monitor.step(0.9);
  std::sort(members.begin(), members.end(), [&look](const auto& a, const auto& b) {
    look(2);
    return a < b;
  });
  monitor.step(0.95);

  UnionVertices out;
  std::vector<std::int32_t> balls;
  for (std::size_t i = 0; i < members.size();) {
    look(32);
    const std::int32_t group = members[i].first;
    balls.clear();
    Vec3 point = points[static_cast<std::size_t>(group)];  // the least, whatever the numbers of the balls
    for (; i < members.size() && members[i].first == group; ++i) {
      const ExposedSide& v = named[static_cast<std::size_t>(members[i].second)];
      point = std::min(point, points[static_cast<std::size_t>(members[i].second)], before);
      const auto& triangle = complex.triangles[static_cast<std::size_t>(v.triangle)];
      balls.insert(balls.end(), triangle.begin(), triangle.end());
      if (v.regular) out.faces.push_back({v.triangle, v.side});
    }
    std::sort(balls.begin(), balls.end());
    balls.erase(std::unique(balls.begin(), balls.end()), balls.end());
    out.points.push_back(point);
    out.balls.insert(out.balls.end(), balls.begin(), balls.end());
    out.ball_offsets.push_back(static_cast<std::int64_t>(out.balls.size()));
    out.face_offsets.push_back(static_cast<std::int64_t>(out.faces.size()));
  }
  return out;
}

}  // namespace ballflow::geometry
