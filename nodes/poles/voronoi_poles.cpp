#include "poles/voronoi_poles.hpp"

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
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"

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

// A nearly regular icosahedron of far-away points. The scales differ so that no symmetry of a sample
// is a symmetry of the far-away points too.
constexpr int far_count = 12;
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

void check_sample(const PointSet& sample, const VoronoiPolesOptions& options) {
  const auto& points = sample.points;
  if (!(options.bounding_distance >= 4 && options.bounding_distance <= 1e6)) {
    throw InputError("bounding_distance is " + std::to_string(options.bounding_distance),
                     "use a distance from 4 to 1e6 bounding-box edges; the default is 10");
  }
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

// Four sites of a Voronoi vertex in ascending order of their coordinates, so that rounding does not depend on
// the numbering of the sample.
using Sites = std::array<std::int32_t, 4>;

class Diagram {
 public:
  Diagram(const PointSet& sample, const VoronoiPolesOptions& options)
      : sample_(sample),
        samples_(static_cast<std::int32_t>(sample.points.size())),
        far_(far_points(bounding_box(sample.points.span()),
                        options.bounding_distance * bounding_box(sample.points.span()).longest_edge())) {}

  void build(Monitor& monitor);
  PoleSet poles(Monitor& monitor) const;

 private:
  Vec3 point(std::int32_t site) const {
    return site < samples_ ? sample_.points[at(site)] : far_[at(site - samples_)];
  }
  // Orders distinct cells by the coordinates of their sites.
  bool canonical_less(std::int32_t a, std::int32_t b) const {
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 p = point(sites_[at(a)][k]), q = point(sites_[at(b)][k]);
      if (p != q) return p < q;
    }
    return false;
  }
  double conditioning(const Sites& sites) const;
  Vec3 circumcentre(const Sites& sites) const;
  // Whether `center` lies behind a pole of sample s: at an obtuse angle to it.
  bool is_behind(std::size_t s, std::int32_t pole, Vec3 center) const {
    const Vec3 p = sample_.points[s];
    return dot(center - p, centers_[at(pole)] - p) < 0;
  }
  void merge_coincident(std::vector<std::pair<std::int32_t, std::int32_t>> pairs);
  std::vector<std::array<std::int32_t, 3>> farthest_vertices(Monitor& monitor) const;
  std::vector<std::uint8_t> poles_and_candidates(const std::vector<std::array<std::int32_t, 3>>& farthest,
                                                 Monitor& monitor) const;

  const PointSet& sample_;
  std::int32_t samples_;
  std::array<Vec3, far_count> far_;
  std::vector<Sites> sites_;             // per cell of the triangulation
  std::vector<Vec3> centers_;            // per cell, equal for the cells of one Voronoi vertex
  std::vector<std::int32_t> vertex_;     // per cell, the cell that stands for its Voronoi vertex
  std::vector<std::uint8_t> unbounded_;  // per cell that stands for a Voronoi vertex, 1 with a far-away site
};

// How far four points are from lying in a plane: det(a, b, c)^2 / (|a| |b| |c|)^2 for the edges at the first.
double Diagram::conditioning(const Sites& sites) const {
  const Vec3 p = point(sites[0]);
  const Vec3 a = point(sites[1]) - p, b = point(sites[2]) - p, c = point(sites[3]) - p;
  const double det = dot(a, cross(b, c));
  const double scale = squared_length(a) * squared_length(b) * squared_length(c);
  return scale > 0 ? det * det / scale : 0;
}

// The circumcentre of p, q, r, s in the arithmetic of Real, or nothing when `conditioning` is not above
// `least`: rounding errors, about 100 units in the last place of the numerator, grow by 1 / sqrt(least).
template <class Real>
std::optional<Vec3> circumcentre(Vec3 p, Vec3 q, Vec3 r, Vec3 s, Real least) {
  using Vector = std::array<Real, 3>;
  const auto edge = [p](Vec3 to) { return Vector{Real(to.x) - p.x, Real(to.y) - p.y, Real(to.z) - p.z}; };
  const auto product = [](const Vector& u, const Vector& v) {
    return Vector{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const auto scalar = [](const Vector& u, const Vector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  };
  const Vector a = edge(q), b = edge(r), c = edge(s);
  const Real aa = scalar(a, a), bb = scalar(b, b), cc = scalar(c, c);
  const Vector bc = product(b, c), ca = product(c, a), ab = product(a, b);
  const Real det = scalar(a, bc), scale = aa * bb * cc;
  if (!(scale > Real(1e-250) && det * det > least * scale)) return std::nullopt;
  const Real factor = Real(0.5) / det;
  const auto coordinate = [&](double from, std::size_t k) {
    return static_cast<double>(from + factor * (aa * bc[k] + bb * ca[k] + cc * ab[k]));
  };
  return Vec3{coordinate(p.x, 0), coordinate(p.y, 1), coordinate(p.z, 2)};
}

// Circumcentres are wrong by at most about 1e-10 radii: flat cells are computed with the 64-bit significand
// of long double, very flat ones exactly. On scans 1 % and 0.01 % of the cells are that flat.
constexpr double well_conditioned = 1e-8;
constexpr long double well_conditioned_long = 1e-14L;
// So no two cells of one Voronoi vertex have computed centres farther apart than this, in radii.
constexpr double coincidence_tolerance = 1e-8;

Vec3 Diagram::circumcentre(const Sites& sites) const {
  const Vec3 p = point(sites[0]), q = point(sites[1]), r = point(sites[2]), s = point(sites[3]);
  if (const auto center = geometry::circumcentre<double>(p, q, r, s, well_conditioned)) return *center;
  if (const auto center = geometry::circumcentre<long double>(p, q, r, s, well_conditioned_long))
    return *center;
  using Exact = CGAL::Simple_cartesian<CGAL::Gmpq>;
  const auto exact = [](Vec3 v) { return Exact::Point_3(v.x, v.y, v.z); };
  const Exact::Point_3 center = CGAL::circumcenter(exact(p), exact(q), exact(r), exact(s));
  return {CGAL::to_double(center.x()), CGAL::to_double(center.y()), CGAL::to_double(center.z())};
}

void Diagram::build(Monitor& monitor) {
  Delaunay triangulation;
  triangulate(sample_, far_, monitor, triangulation);
  std::vector<Delaunay::Cell_handle> cells;
  cells.reserve(triangulation.number_of_cells());
  for (auto cell = triangulation.all_cells_begin(); cell != triangulation.all_cells_end(); ++cell) {
    if (triangulation.is_infinite(cell)) {
      cell->info() = -1;
    } else {
      cell->info() = static_cast<std::int32_t>(cells.size());
      cells.push_back(cell);
    }
  }
  monitor.step(0.75);

  sites_.resize(cells.size());
  centers_.resize(cells.size());
  const tbb::blocked_range<std::size_t> all(0, cells.size(), 4096);
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    if (monitor.cancelled()) throw Cancelled();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      Sites& sites = sites_[i];
      for (int k = 0; k < 4; ++k) sites[static_cast<std::size_t>(k)] = cells[i]->vertex(k)->info();
      std::sort(sites.begin(), sites.end(),
                [this](std::int32_t a, std::int32_t b) { return point(a) < point(b); });
      centers_[i] = circumcentre(sites);
    }
  });
  monitor.step(0.85);

  double magnitude = 0;  // of coordinates: adding the translation back rounds to that scale
  for (std::int32_t k = 0; k < far_count; ++k) {
    const Vec3 p = point(samples_ + k);
    magnitude = std::max({magnitude, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  tbb::enumerable_thread_specific<std::vector<std::pair<std::int32_t, std::int32_t>>> coincident;
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    if (monitor.cancelled()) throw Cancelled();
    auto& found = coincident.local();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const double radius = distance(centers_[i], point(sites_[i][0]));
      const double near = coincidence_tolerance * radius + 1e-14 * magnitude;
      for (int k = 0; k < 4; ++k) {
        const auto neighbour = cells[i]->neighbor(k);
        const std::int32_t j = neighbour->info();
        if (j <= static_cast<std::int32_t>(i)) continue;  // each pair once; -1 is infinite
        if (squared_distance(centers_[i], centers_[at(j)]) > near * near) continue;
        const Point& opposite = neighbour->vertex(neighbour->index(cells[i]))->point();
        const auto corner = [&](int c) -> const Point& { return cells[i]->vertex(c)->point(); };
        if (CGAL::side_of_oriented_sphere(corner(0), corner(1), corner(2), corner(3), opposite) ==
            CGAL::ON_ORIENTED_BOUNDARY) {
          found.emplace_back(static_cast<std::int32_t>(i), j);
        }
      }
    }
  });
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const auto& found : coincident) pairs.insert(pairs.end(), found.begin(), found.end());
  merge_coincident(std::move(pairs));
  unbounded_.assign(sites_.size(), 0);
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    for (const std::int32_t site : sites_[i]) {
      if (site >= samples_) unbounded_[at(vertex_[i])] = 1;
    }
  }
  monitor.step(0.9);
}

// Cells around one Voronoi vertex get one representative, the best conditioned one (its centre is the most
// accurate), and its centre.
void Diagram::merge_coincident(std::vector<std::pair<std::int32_t, std::int32_t>> pairs) {
  vertex_.resize(sites_.size());
  std::iota(vertex_.begin(), vertex_.end(), 0);
  DisjointSets coincident(sites_.size());
  std::vector<std::int32_t> members;
  for (const auto& [a, b] : pairs) {
    members.push_back(a);
    members.push_back(b);
    coincident.join(a, b);
  }
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
  std::vector<std::pair<std::int32_t, std::int32_t>> grouped;  // root, member
  grouped.reserve(members.size());
  for (const std::int32_t cell : members) grouped.emplace_back(coincident.root(cell), cell);
  std::sort(grouped.begin(), grouped.end());
  for (std::size_t first = 0; first < grouped.size();) {
    std::size_t last = first;
    std::int32_t best = grouped[first].second;
    double best_conditioning = -1;
    for (; last < grouped.size() && grouped[last].first == grouped[first].first; ++last) {
      const std::int32_t cell = grouped[last].second;
      const double value = conditioning(sites_[at(cell)]);
      if (value > best_conditioning || (value == best_conditioning && canonical_less(cell, best))) {
        best = cell;
        best_conditioning = value;
      }
    }
    for (; first < last; ++first) {
      vertex_[at(grouped[first].second)] = best;
      centers_[at(grouped[first].second)] = centers_[at(best)];
    }
  }
}

// For each sample the cells that stand for its first two poles.
std::vector<std::array<std::int32_t, 3>> Diagram::farthest_vertices(Monitor& monitor) const {
  std::vector<std::array<std::int32_t, 3>> farthest(at(samples_), {-1, -1, -1});
  std::vector<double> greatest(at(samples_), -1.0);
  // Calls accept(sample, center) for the vertices of all cells, and keeps the farthest of those accepted.
  const auto keep_farthest = [&](std::size_t side, std::uint8_t unbounded_side, const auto& accept) {
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (i % (1 << 16) == 0 && monitor.cancelled()) throw Cancelled();
      const std::int32_t candidate = vertex_[i];
      if (unbounded_[at(candidate)] > unbounded_side) continue;
      const Vec3 center = centers_[i];
      for (const std::int32_t s : sites_[i]) {
        if (s >= samples_) continue;
        const double d = squared_distance(center, sample_.points[at(s)]);
        if (d < greatest[at(s)] || !accept(at(s), center)) continue;
        std::int32_t& best = farthest[at(s)][side];
        if (d == greatest[at(s)]) {
          if (best == candidate) continue;
          const Vec3 other = centers_[at(best)];
          if (other < center || (other == center && canonical_less(best, candidate))) continue;
        }
        greatest[at(s)] = d;
        best = candidate;
      }
    }
  };
  keep_farthest(0, 1, [](std::size_t, Vec3) { return true; });
  monitor.step(0.92);
  const auto behind = [&](std::size_t s, Vec3 center) { return is_behind(s, farthest[s][0], center); };
  std::fill(greatest.begin(), greatest.end(), -1.0);
  keep_farthest(1, 0, behind);
  // Only where nothing else is on the other side an unbounded vertex is the second pole: samples of thin
  // sheets.
  if (std::any_of(farthest.begin(), farthest.end(), [](const auto& own) { return own[1] < 0; })) {
    keep_farthest(1, 1, [&](std::size_t s, Vec3 center) {
      const std::int32_t found = farthest[s][1];
      return (found < 0 || unbounded_[at(found)] == 1) && behind(s, center);
    });
  }
  monitor.step(0.94);
  return farthest;
}

// The cosine of the angle from which on two poles are opposite. On a smooth surface each pole of an r-sample
// is within 2 arcsin(r / (1 - r)) of a normal [Kornberger 2010, proof of Lemma 4.8], so two poles of a sample
// are more than 139 degrees apart for r <= 0.15; this is the cosine of 138.6.
constexpr double opposite = -0.75;

// Per cell that stands for a Voronoi vertex, 1 for poles and for candidates: where the poles of a sample are
// not opposite they may be on one side of the surface, so all bounded vertices behind the first are kept.
std::vector<std::uint8_t> Diagram::poles_and_candidates(
    const std::vector<std::array<std::int32_t, 3>>& farthest, Monitor& monitor) const {
  std::vector<std::uint8_t> kept(sites_.size(), 0), blunt(farthest.size(), 0);
  for (std::size_t s = 0; s < farthest.size(); ++s) {
    blunt[s] = 1;
    const std::int32_t first = farthest[s][0], second = farthest[s][1];
    kept[at(first)] = 1;
    if (second < 0) continue;
    kept[at(second)] = 1;
    const Vec3 u = centers_[at(first)] - sample_.points[s], v = centers_[at(second)] - sample_.points[s];
    const double product = dot(u, v);  // negative: the second pole is behind the first
    if (product * product >= opposite * opposite * squared_length(u) * squared_length(v)) blunt[s] = 0;
  }
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (i % (1 << 16) == 0 && monitor.cancelled()) throw Cancelled();
    if (unbounded_[at(vertex_[i])] == 1 || kept[at(vertex_[i])] == 1) continue;
    for (const std::int32_t s : sites_[i]) {
      if (s >= samples_ || blunt[at(s)] == 0) continue;
      if (is_behind(at(s), farthest[at(s)][0], centers_[i])) kept[at(vertex_[i])] = 1;
    }
  }
  return kept;
}

PoleSet Diagram::poles(Monitor& monitor) const {
  std::vector<std::array<std::int32_t, 3>> sample_poles = farthest_vertices(monitor);
  const std::vector<std::uint8_t> kept = poles_and_candidates(sample_poles, monitor);

  // Number the vertices that are kept, and collect the sites of all cells around each of them.
  std::vector<std::int32_t> number(sites_.size(), -1);
  std::vector<std::int32_t> cell_of;
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (kept[i] == 0) continue;
    number[i] = static_cast<std::int32_t>(cell_of.size());
    cell_of.push_back(static_cast<std::int32_t>(i));
  }
  monitor.step(0.95);
  const std::size_t count = cell_of.size();
  std::vector<std::int64_t> begin(count + 1, 0);
  for (const std::int32_t cell : vertex_) {
    if (number[at(cell)] >= 0) begin[at(number[at(cell)]) + 1] += 4;
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::int32_t> collected(static_cast<std::size_t>(begin[count]));
  std::vector<std::int64_t> end(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    const std::int32_t pole = number[at(vertex_[i])];
    if (i % (1 << 16) == 0 && monitor.cancelled()) throw Cancelled();
    if (pole < 0) continue;
    for (const std::int32_t site : sites_[i]) collected[static_cast<std::size_t>(end[at(pole)]++)] = site;
  }
  std::vector<std::uint8_t> bounded_by_far(count, 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const auto first = collected.begin() + begin[i], last = collected.begin() + end[i];
      std::sort(first, last);
      auto stop = std::unique(first, last);
      while (stop != first && *(stop - 1) >= samples_) {
        bounded_by_far[i] = 1;
        --stop;
      }
      end[i] = stop - collected.begin();
    }
  });
  monitor.step(0.96);

  // Order them by their defining samples: in buckets of the smallest one, which every vertex has, then within
  // each bucket.
  const auto smallest = [&](std::size_t i) { return at(collected[static_cast<std::size_t>(begin[i])]); };
  std::vector<std::int32_t> bucket(at(samples_) + 1, 0), order(count);
  for (std::size_t i = 0; i < count; ++i) ++bucket[smallest(i) + 1];
  std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
  std::vector<std::int32_t> next(bucket.begin(), bucket.end() - 1);
  for (std::size_t i = 0; i < count; ++i) order[at(next[smallest(i)]++)] = static_cast<std::int32_t>(i);
  const auto before = [&](std::int32_t x, std::int32_t y) {
    const std::size_t a = at(x), b = at(y);
    const auto [ka, kb] = std::mismatch(collected.begin() + begin[a], collected.begin() + end[a],
                                        collected.begin() + begin[b], collected.begin() + end[b]);
    const bool ended_a = ka == collected.begin() + end[a], ended_b = kb == collected.begin() + end[b];
    if (!ended_a && !ended_b) return *ka < *kb;
    if (ended_a != ended_b) return ended_a;
    // Both ends of a Voronoi edge that leads to far-away points on both sides.
    const Vec3 p = centers_[at(cell_of[a])], q = centers_[at(cell_of[b])];
    return p != q ? p < q : canonical_less(cell_of[a], cell_of[b]);
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, at(samples_), 4096), [&](const auto& range) {
    if (monitor.cancelled()) throw Cancelled();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      std::sort(order.begin() + bucket[i], order.begin() + bucket[i + 1], before);
    }
  });
  monitor.step(0.98);

  std::vector<std::int32_t> rank(count);
  std::vector<Vec3> centers(count);
  std::vector<double> radii(count);
  std::vector<std::uint8_t> unbounded(count);
  std::vector<std::int64_t> offsets(count + 1, 0);
  std::vector<std::int32_t> defining;
  defining.reserve(collected.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t pole = at(order[i]);
    rank[pole] = static_cast<std::int32_t>(i);
    centers[i] = centers_[at(cell_of[pole])];
    unbounded[i] = bounded_by_far[pole];
    double greatest = 0;
    for (std::int64_t k = begin[pole]; k < end[pole]; ++k) {
      const std::int32_t s = collected[static_cast<std::size_t>(k)];
      defining.push_back(s);
      greatest = std::max(greatest, squared_distance(centers[i], sample_.points[at(s)]));
    }
    radii[i] = std::sqrt(greatest);
    offsets[i + 1] = static_cast<std::int64_t>(defining.size());
  }
  for (auto& own : sample_poles) {
    for (std::int32_t& cell : own) cell = cell < 0 ? -1 : rank[at(number[at(cell)])];
  }

  PoleSet result;
  result.centers = std::move(centers);
  result.radii = std::move(radii);
  result.labels = std::vector<std::uint8_t>(count, static_cast<std::uint8_t>(PoleLabel::unlabelled));
  result.defining_offsets = std::move(offsets);
  result.defining_samples = std::move(defining);
  result.unbounded = std::move(unbounded);
  result.sample_poles = std::move(sample_poles);
  return result;
}

}  // namespace

PoleSet voronoi_poles(const PointSet& sample, const VoronoiPolesOptions& options, Monitor& monitor) {
  check_sample(sample, options);
  check_not_coplanar(sample);
  Diagram diagram(sample, options);
  diagram.build(monitor);
  return diagram.poles(monitor);
}

}  // namespace ballflow::geometry
