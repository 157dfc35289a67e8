#include "poles/voronoi_diagram.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/index.hpp"
#include "exact/double_double.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel,
                                                           CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

Point to_point(Vec3 v) { return {v.x, v.y, v.z}; }
std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

using Sites = VoronoiDiagram::Sites;
constexpr int far_count = VoronoiDiagram::far_count;

// A nearly regular icosahedron of far-away points. The scales differ so that no symmetry of a sample
// is a symmetry of the far-away points too.
std::array<Vec3, far_count> far_points(const Box& box, double distance) {
  const Vec3 middle = 0.5 * (box.lower + box.upper);
  constexpr double longer = 1.618, length = 1.902;  // golden ratio, length of (0, 1, golden ratio)
  std::array<Vec3, far_count> points;
  for (int k = 0; k < far_count; ++k) {
    const double u = (k & 1) != 0 ? 1 : -1;
    const double v = (k & 2) != 0 ? longer : -longer;
    const Vec3 direction = k < 4 ? Vec3{0, u, v} : k < 8 ? Vec3{u, v, 0} : Vec3{v, 0, u};
    points[static_cast<std::size_t>(k)] = middle + distance * (1 + 0.01 * k) / length * direction;
  }
  return points;
}
void check_sample(const PointSet& sample) {
  const auto& points = sample.points;
  if (points.size() < 4) {
    throw InputError("the sample has " + std::to_string(points.size()) + " points, a Voronoi vertex needs 4",
                     "sample the surface more densely");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) {
      throw InputError("sample " + std::to_string(i) + " has a coordinate that is not finite",
                       "remove the point, or repair the file it came from");
    }
  }
  const double extent = bounding_box(points.span()).longest_edge();
  if (extent > 1e40 || (extent < 1e-40 && extent > 0)) {
    throw InputError("the longest edge of the bounding box is outside [1e-40, 1e40] model units",
                     "scale the model to a unit in which it has an ordinary size");
  }
}

// Refuses samples in one plane: their Voronoi diagram has no vertices.
void check_not_coplanar(const PointSet& sample) {
  const auto& points = sample.points;
  const Point a = to_point(points[0]);
  std::size_t i = 1;
  while (i < points.size() && points[i] == points[0]) ++i;
  if (i < points.size()) {
    const Point b = to_point(points[i]);
    while (i < points.size() && CGAL::collinear(a, b, to_point(points[i]))) ++i;
    if (i < points.size()) {
      const Point c = to_point(points[i]);
      while (i < points.size() && CGAL::coplanar(a, b, c, to_point(points[i]))) ++i;
    }
  }
  if (i < points.size()) return;
  throw InputError("all " + std::to_string(points.size()) + " samples lie in one plane",
                   "a solid needs samples all around it: check the file, or sample a closed surface");
}

[[noreturn]] void throw_duplicate(const PointSet& sample) {
  std::vector<std::int32_t> order(sample.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return std::tie(sample.points[at(a)], a) < std::tie(sample.points[at(b)], b);
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (sample.points[at(order[i])] != sample.points[at(order[i - 1])]) continue;
    throw InputError("samples " + std::to_string(order[i - 1]) + " and " + std::to_string(order[i]) +
                         " are the same point",
                     "merge equal points first");
  }
  throw InputError("the sample contains equal points", "merge equal points first");
}

// The Delaunay triangulation of the sample and the far-away points; info of a vertex is the sample, or
// n + k for far-away point k. It is unique (degenerate cases are perturbed symbolically by coordinates), so
// the order of insertion does not matter.
void triangulate(const PointSet& sample, const std::array<Vec3, far_count>& far, Monitor& monitor,
                 Delaunay& out) {
  const std::size_t n = sample.points.size();
  for (int k = 0; k < far_count; ++k) {
    out.insert(to_point(far[static_cast<std::size_t>(k)]))->info() = static_cast<std::int32_t>(n) + k;
  }
  std::vector<Point> points;
  points.reserve(n);
  for (const Vec3& p : sample.points) points.push_back(to_point(p));
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  using PointMap = CGAL::Pointer_property_map<Point>::type;
  CGAL::spatial_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_3<Kernel, PointMap>(CGAL::make_property_map(points)));
  Delaunay::Cell_handle hint;
  std::size_t expected = out.number_of_vertices();
  for (std::size_t i = 0; i < n; ++i) {
    const auto vertex = out.insert(points[order[i]], hint);
    if (out.number_of_vertices() != ++expected) throw_duplicate(sample);
    vertex->info() = static_cast<std::int32_t>(order[i]);
    hint = vertex->cell();
    if (i % 512 == 0) monitor.step(0.7 * static_cast<double>(i) / static_cast<double>(n));
  }
}

std::array<Vec3, 4> corners(const VoronoiDiagram& diagram, std::size_t cell) {
  const Sites& sites = diagram.sites[cell];
  return {diagram.point(sites[0]), diagram.point(sites[1]), diagram.point(sites[2]), diagram.point(sites[3])};
}

// How far four points are from lying in a plane: det(a, b, c)^2 / (|a| |b| |c|)^2 for the edges at the first.
double conditioning(const std::array<Vec3, 4>& points) {
  const Vec3 a = points[1] - points[0], b = points[2] - points[0], c = points[3] - points[0];
  const double det = dot(a, cross(b, c));
  const double scale = squared_length(a) * squared_length(b) * squared_length(c);
  return scale > 0 ? det * det / scale : 0;
}

// The circumcentre of p, q, r, s in the arithmetic of Real, or nothing when `conditioning` is not above
// `least`: rounding errors, about 100 units in the last place of the numerator, grow by 1 / sqrt(least).
template <class Real>
std::optional<Vec3> circumcentre(Vec3 p, Vec3 q, Vec3 r, Vec3 s, double least) {
  using Vector = std::array<Real, 3>;
  const auto edge = [p](Vec3 to) {
    return Vector{difference_of<Real>(to.x, p.x), difference_of<Real>(to.y, p.y),
                  difference_of<Real>(to.z, p.z)};
  };
  const auto product = [](const Vector& u, const Vector& v) {
    return Vector{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const auto scalar = [](const Vector& u, const Vector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  const Vector a = edge(q), b = edge(r), c = edge(s);
  const Real aa = scalar(a, a), bb = scalar(b, b), cc = scalar(c, c);
  if constexpr (std::is_same_v<Real, DoubleDouble>) {
    // So that the second halves of what is multiplied below neither vanish nor overflow.
    const auto [shortest, longest] = std::minmax({nearest(aa), nearest(bb), nearest(cc)});
    if (!(shortest > 1e-90 && longest < 1e90)) return std::nullopt;
  }
  const Vector bc = product(b, c), ca = product(c, a), ab = product(a, b);
  const Real det = scalar(a, bc), scale = aa * bb * cc;
  if (!(nearest(scale) > 1e-250 && nearest(det * det) > least * nearest(scale))) return std::nullopt;
  const Real factor = Real{0.5} / det;
  const auto coordinate = [&](double from, std::size_t k) {
    return nearest(Real{from} + factor * (aa * bc[k] + bb * ca[k] + cc * ab[k]));
  };
  return Vec3{coordinate(p.x, 0), coordinate(p.y, 1), coordinate(p.z, 2)};
}

// Circumcentres are wrong by at most about 1e-10 radii: flat cells are computed with pairs of doubles, very
// flat ones exactly. On scans 1 % of the cells are flat; of the very flat ones most are in one plane.
constexpr double well_conditioned = 1e-8, well_conditioned_in_pairs = 1e-32;
// So no two cells of one Voronoi vertex have computed centres farther apart than this, in radii.
constexpr double coincidence_tolerance = 1e-8;

Vec3 circumcentre(const std::array<Vec3, 4>& points) {
  const auto [p, q, r, s] = points;
  if (const auto center = circumcentre<double>(p, q, r, s, well_conditioned)) return *center;
  if (const auto center = circumcentre<DoubleDouble>(p, q, r, s, well_conditioned_in_pairs)) return *center;
  using Exact = CGAL::Simple_cartesian<CGAL::Gmpq>;
  const auto exact = [](Vec3 v) { return Exact::Point_3(v.x, v.y, v.z); };
  const Exact::Point_3 center = CGAL::circumcenter(exact(p), exact(q), exact(r), exact(s));
  return {CGAL::to_double(center.x()), CGAL::to_double(center.y()), CGAL::to_double(center.z())};
}

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

// Pairs of neighbouring cells with one Voronoi vertex, in any order. `cells` are those of the diagram.
Pairs coincident_neighbours(const VoronoiDiagram& diagram, const std::vector<Delaunay::Cell_handle>& cells,
                            Monitor& monitor) {
  double magnitude = 0;  // of coordinates: adding the translation back rounds to that scale
  for (const Vec3& p : diagram.far)
    magnitude = std::max({magnitude, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  tbb::enumerable_thread_specific<Pairs> coincident;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 4096), [&](const auto& range) {
    if (monitor.cancelled()) throw Cancelled();
    Pairs& found = coincident.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const double radius = distance(diagram.centers[i], diagram.point(diagram.sites[i][0]));
      const double near = coincidence_tolerance * radius + 1e-14 * magnitude;
      for (int k = 0; k < 4; ++k) {
        const auto neighbour = cells[i]->neighbor(k);
        const std::int32_t j = neighbour->info();
        if (j <= static_cast<std::int32_t>(i)) continue;  // each pair once; -1 is infinite
        if (squared_distance(diagram.centers[i], diagram.centers[at(j)]) > near * near) continue;
        const Point& opposite = neighbour->vertex(neighbour->index(cells[i]))->point();
        const auto corner = [&](int c) -> const Point& { return cells[i]->vertex(c)->point(); };
        if (CGAL::side_of_oriented_sphere(corner(0), corner(1), corner(2), corner(3), opposite) ==
            CGAL::ON_ORIENTED_BOUNDARY) {
          found.emplace_back(static_cast<std::int32_t>(i), j);
        }
      }
    }
  });
  Pairs pairs;
  for (const Pairs& found : coincident) pairs.insert(pairs.end(), found.begin(), found.end());
  return pairs;
}

// Cells around one Voronoi vertex get one representative, the best conditioned one (its centre is the most
// accurate), and its centre.
void merge_coincident(VoronoiDiagram& diagram, const Pairs& pairs) {
  diagram.vertex.resize(diagram.size());
  std::iota(diagram.vertex.begin(), diagram.vertex.end(), 0);
  DisjointSets coincident(diagram.size());
  std::vector<std::int32_t> members;
  for (const auto& [a, b] : pairs) {
    members.push_back(a);
    members.push_back(b);
    coincident.join(a, b);
  }
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
  Pairs grouped;  // root, member
  grouped.reserve(members.size());
  for (const std::int32_t cell : members) grouped.emplace_back(coincident.root(cell), cell);
  std::sort(grouped.begin(), grouped.end());
  for (std::size_t first = 0; first < grouped.size();) {
    std::size_t last = first;
    std::int32_t best = grouped[first].second;
    double best_conditioning = -1;
    for (; last < grouped.size() && grouped[last].first == grouped[first].first; ++last) {
      const std::int32_t cell = grouped[last].second;
      const double value = conditioning(corners(diagram, at(cell)));
      if (value > best_conditioning || (value == best_conditioning && diagram.cell_before(cell, best))) {
        best = cell;
        best_conditioning = value;
      }
    }
    for (; first < last; ++first) {
      diagram.vertex[at(grouped[first].second)] = best;
      diagram.centers[at(grouped[first].second)] = diagram.centers[at(best)];
    }
  }
}

}  // namespace

bool VoronoiDiagram::cell_before(std::int32_t a, std::int32_t b) const {
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 p = point(sites[at(a)][k]), q = point(sites[at(b)][k]);
    if (p != q) return p < q;
  }
  return false;
}

VoronoiDiagram voronoi_diagram(const PointSet& sample, double bounding_distance, Monitor& monitor) {
  check_sample(sample);
  check_not_coplanar(sample);
  const Box box = bounding_box(sample.points.span());
  VoronoiDiagram diagram{
      sample.points, far_points(box, bounding_distance * box.longest_edge()), {}, {}, {}, {}};
  Delaunay triangulation;
  triangulate(sample, diagram.far, monitor, triangulation);
  std::vector<Delaunay::Cell_handle> cells;
  cells.reserve(triangulation.number_of_cells());
  for (auto cell = triangulation.all_cells_begin(); cell != triangulation.all_cells_end(); ++cell) {
    if (triangulation.is_infinite(cell)) {
      cell->info() = -1;
    } else {
      cell->info() = index_of(cells.size(), "cells of the Delaunay triangulation");
      cells.push_back(cell);
    }
  }
  monitor.step(0.75);

  diagram.sites.resize(cells.size());
  diagram.centers.resize(cells.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 4096), [&](const auto& range) {
    if (monitor.cancelled()) throw Cancelled();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      Sites& sites = diagram.sites[i];
      for (int k = 0; k < 4; ++k) sites[static_cast<std::size_t>(k)] = cells[i]->vertex(k)->info();
      std::sort(sites.begin(), sites.end(),
                [&](std::int32_t a, std::int32_t b) { return diagram.point(a) < diagram.point(b); });
      diagram.centers[i] = circumcentre(corners(diagram, i));
    }
  });
  monitor.step(0.85);

  merge_coincident(diagram, coincident_neighbours(diagram, cells, monitor));
  diagram.unbounded.assign(cells.size(), 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const std::int32_t site : diagram.sites[i]) {
      if (!diagram.is_sample(site)) diagram.unbounded[at(diagram.vertex[i])] = 1;
    }
  }
  monitor.step(0.9);
  return diagram;
}

}  // namespace ballflow::geometry
