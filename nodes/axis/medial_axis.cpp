// Why the result has the homotopy type of the union. Let T_w be the triangle of the boundary of R that names
// w in W. For a point x = sum l_i c_i of a simplex of K and any p, |x - p|^2 = sum l_i |c_i - p|^2 -
// const(x), and |c_i - w| >= r_i with equality on the spheres through w. Hence T_w lies in V(w), simplices
// without w on all their spheres do not lie nearer to w, and a segment from a point of V(w) in R to w leaves
// R exactly once, through T_w. So R falls into the convex polytopes P_w = {x in V(w) on the inner side of
// T_w}; T_w is the only facet of P_w on the boundary of R. Pushing every P_w from T_w onto its other facets
// is a deformation of R onto R intersected with V. Where one w has several triangles the segments leave
// through one of them, and the same push works.
//
// The facets of P_w other than T_w are pieces of Voronoi facets V(w) * V(w'); a Voronoi facet is cut by the
// boundary of R along edges ij that triangles of w and w' share, so that every cut point is a ball centre. It
// therefore suffices to know which Voronoi vertices lie in R, and no intersection is ever computed. The
// centre of a ball lies on every Voronoi edge whose three sites are on its sphere, for no site is nearer to
// it. All W on one ball are cospherical: their Delaunay cells all have the ball's centre as circumcentre.
// This is decided by names, never by coordinates, so that rounding cannot tear the centre apart.
#include "axis/medial_axis.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "power/union_vertices.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
Kernel::Point_3 point(Vec3 p) { return {p.x, p.y, p.z}; }

// --- The Delaunay triangulation of W as plain arrays, in an order that depends on names only.

constexpr std::int32_t infinite = std::numeric_limits<std::int32_t>::max();

struct DelaunayCell {
  std::array<std::int32_t, 4> corners;    // indices of W, ascending; an infinite cell ends with `infinite`
  std::array<std::int32_t, 4> neighbors;  // neighbors[k] lies opposite corners[k]
  bool finite() const { return corners[3] != infinite; }
};

/// Empty when the points lie in a plane.
std::vector<DelaunayCell> delaunay_cells(const std::vector<Vec3>& points, Monitor& monitor) {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel>;
  using Cell = CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Kernel>;
  using Triangulation =
      CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
  std::vector<Kernel::Point_3> sites;
  sites.reserve(points.size());
  for (const Vec3& p : points) sites.push_back(point(p));
  std::vector<std::size_t> order(sites.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  using SiteMap = CGAL::Pointer_property_map<Kernel::Point_3>::type;
  CGAL::spatial_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_3<Kernel, SiteMap>(CGAL::make_property_map(sites)));
  Triangulation triangulation;
  Triangulation::Cell_handle hint;
  for (std::size_t i = 0; i < order.size(); ++i) {  // one by one, to look at the monitor in between
    if (i % 512 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(order.size()));
    const auto vertex = triangulation.insert(sites[order[i]], hint);
    vertex->info() = static_cast<std::int32_t>(order[i]);
    hint = vertex->cell();
  }
  if (triangulation.dimension() < 3) return {};

  struct Entry {
    std::array<std::int32_t, 4> corners;
    std::array<std::int8_t, 4> place;  // of corners[k] among the vertices of the cell
    Triangulation::Cell_handle cell;
  };
  std::vector<Entry> entries;
  entries.reserve(triangulation.number_of_cells());
  triangulation.infinite_vertex()->info() = infinite;
  Lookout look(monitor);
  for (auto cell = triangulation.all_cells_begin(); cell != triangulation.all_cells_end(); ++cell) {
    look(32);
    Entry entry{{}, {0, 1, 2, 3}, cell};
    const auto name = [&](int k) { return cell->vertex(k)->info(); };
    std::sort(entry.place.begin(), entry.place.end(), [&](int a, int b) { return name(a) < name(b); });
    for (std::size_t k = 0; k < 4; ++k) entry.corners[k] = name(entry.place[k]);
    entries.push_back(entry);
  }
  monitor.step(0.9);
  std::sort(entries.begin(), entries.end(), [&look](const Entry& a, const Entry& b) {
    look(4);
    return a.corners < b.corners;
  });
  monitor.step(0.95);
  for (std::size_t i = 0; i < entries.size(); ++i) entries[i].cell->info() = static_cast<std::int32_t>(i);
  std::vector<DelaunayCell> cells;
  cells.reserve(entries.size());
  for (const Entry& entry : entries) {
    look(16);
    DelaunayCell cell{entry.corners, {}};
    for (std::size_t k = 0; k < 4; ++k) cell.neighbors[k] = entry.cell->neighbor(entry.place[k])->info();
    cells.push_back(cell);
  }
  return cells;
}

// --- Circumcentres.

/// With Number = double: false when the tetrahedron is so flat that cancellation may have spoilt the result.
template <class Number>
bool circumcenter(const std::array<Vec3, 4>& p, Vec3& out) {
  struct V {
    Number x, y, z;
  };
  const auto edge = [&p](std::size_t k) {
    return V{Number(p[k].x) - Number(p[0].x), Number(p[k].y) - Number(p[0].y),
             Number(p[k].z) - Number(p[0].z)};
  };
  const auto cross_of = [](const V& a, const V& b) {
    return V{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const auto dot_of = [](const V& a, const V& b) -> Number { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const V a = edge(1), b = edge(2), c = edge(3);
  const V ab = cross_of(a, b), bc = cross_of(b, c), ca = cross_of(c, a);
  const Number aa = dot_of(a, a), bb = dot_of(b, b), cc = dot_of(c, c);
  const Number det = dot_of(a, bc);
  if constexpr (std::is_same_v<Number, double>) {
    constexpr double flat = 1e-3;  // errors stay below some 1e-12 of the size of the tetrahedron
    if (!(det * det > flat * flat * aa * bb * cc)) return false;
  }
  const Number scale = Number(2) * det;
  const auto along = [&](const Number& x, const Number& y, const Number& z) {
    return CGAL::to_double(Number((aa * x + bb * y + cc * z) / scale));
  };
  out = p[0] + Vec3{along(bc.x, ca.x, ab.x), along(bc.y, ca.y, ab.y), along(bc.z, ca.z, ab.z)};
  return true;
}

// --- Paths along edges of the complex.

/// The vertices strictly between `from` and `to` on a shortest path along the edges; none without a path.
std::vector<std::int32_t> path_between(std::int32_t from, std::int32_t to,
                                       std::span<const std::array<std::int32_t, 2>> edges) {
  std::vector<std::array<std::int32_t, 2>> reached{{from, -1}};  // vertex, index of its predecessor
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const auto& edge : edges) {
      if (edge[0] != reached[i][0] && edge[1] != reached[i][0]) continue;
      const std::int32_t next = edge[0] + edge[1] - reached[i][0];
      const bool known =
          std::any_of(reached.begin(), reached.end(), [&](const auto& r) { return r[0] == next; });
      if (known) continue;
      reached.push_back({next, static_cast<std::int32_t>(i)});
      if (next != to) continue;
      std::vector<std::int32_t> path;
      for (std::int32_t k = reached.back()[1]; k > 0; k = reached[at(k)][1])
        path.push_back(reached[at(k)][0]);
      std::reverse(path.begin(), path.end());
      return path;
    }
  }
  return {};
}

// --- Voronoi vertices: where they are and what they are called.

enum class Place : std::uint8_t { out, in, on };

/// A Voronoi vertex: one or more Delaunay cells with the same circumcentre.
struct VoronoiVertex {
  Place place = Place::out;
  // A ball for Place::on, whose centre this is; else (number of balls) + (lowest Delaunay cell).
  std::int32_t name = 0;
};

class Axis {
 public:
  Axis(const SimplicialComplex& complex, Monitor& monitor)
      : complex_(complex), monitor_(monitor), look_(monitor) {}

  MedialAxis run() {
    if (!complex_.tetrahedra.empty()) {
      add_regular_part();
    }
    add_singular_part();
    return finish();
  }

 private:
  using Polygon = std::vector<std::int32_t>;  // names of the corners
  using Edge = std::array<std::int32_t, 2>;

  std::int32_t balls() const { return static_cast<std::int32_t>(complex_.centers.size()); }
  Vec3 center(std::int32_t ball) const { return complex_.centers[at(ball)]; }

  void add_regular_part();
  void place_cells();
  void merge_coincident();
  bool all_on(std::int32_t ball, std::span<const std::int32_t> sites) const;
  std::int32_t common_ball(std::span<const std::int32_t> sites) const;
  double depth(std::int32_t w, Vec3 x) const;
  void add_facets();
  void add_facet(std::int32_t w0, std::int32_t w1, std::span<const std::int32_t> ring,
                 std::span<const std::int32_t> apexes);
  void keep_inside(Polygon polygon, std::int32_t w0, std::int32_t w1, bool cut);
  void add_polygon(const Polygon& polygon, AxisKind kind);
  void add_singular_part();
  MedialAxis finish();

  const SimplicialComplex& complex_;
  Monitor& monitor_;
  Lookout look_;
  double size_ = 0;  // longest edge of the bounding box of the union
  double same_ = 0;  // Voronoi vertices so close to a ball centre or to the boundary of R are on it

  UnionVertices sites_;
  std::vector<DelaunayCell> cells_;
  std::vector<VoronoiVertex> vertices_;  // one per cell
  std::vector<Vec3> positions_;          // one per cell: circumcentre, meaningless for centres of balls

  struct Piece {
    Polygon corners;
    AxisKind kind;
  };
  std::vector<Piece> pieces_;
  std::vector<Edge> edges_;
  std::vector<std::int32_t> isolated_;
};

/// Whether the sphere of the ball passes through all the sites.
bool Axis::all_on(std::int32_t ball, std::span<const std::int32_t> sites) const {
  return std::all_of(sites.begin(), sites.end(), [&](std::int32_t w) {
    const auto all = sites_.balls_of(at(w));
    return std::find(all.begin(), all.end(), ball) != all.end();
  });
}

/// The smallest ball with all the given sites on its sphere, -1 when there is none.
std::int32_t Axis::common_ball(std::span<const std::int32_t> sites) const {
  for (const std::int32_t ball : sites_.balls_of(at(sites[0]))) {
    if (all_on(ball, sites.subspan(1))) return ball;
  }
  return -1;
}

/// How deep x, a point of the cell of w, lies in R as seen from w: positive inside, negative outside.
double Axis::depth(std::int32_t w, Vec3 x) const {
  const auto plane = [&](const UnionVertices::Face& face) {
    const auto& t = complex_.triangles[at(face.triangle)];
    const Vec3 a = center(t[0]), b = center(t[1]), c = center(t[2]);
    const double side = -face.outside * CGAL::orientation(point(a), point(b), point(c), point(x));
    const Vec3 n = cross(b - a, c - a);
    return side * std::abs(dot(n, x - a)) / length(n);
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
    outward = outward + (face.outside / length(n)) * n;
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

void Axis::place_cells() {
  vertices_.resize(cells_.size());
  positions_.resize(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (i % 4096 == 0) monitor_.step(0.5 + 0.2 * static_cast<double>(i) / static_cast<double>(cells_.size()));
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
    if (!circumcenter<double>(corners, positions_[i]))
      circumcenter<CGAL::Exact_rational>(corners, positions_[i]);
    const Vec3 x = positions_[i];
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
void Axis::merge_coincident() {
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
    if (i % 65536 == 0) monitor_.step(0.7);
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

void Axis::add_regular_part() {
  Box box;
  for (const std::int32_t b : complex_.vertices) {
    const double r = std::sqrt(std::max(0.0, complex_.weights[at(b)]));
    box.add(center(b) - Vec3{r, r, r});
    box.add(center(b) + Vec3{r, r, r});
  }
  size_ = box.longest_edge();
  same_ = std::ldexp(size_, -36);
  PartMonitor first(monitor_, 0, 0.1), second(monitor_, 0.1, 0.5);
  sites_ = union_vertices(complex_, std::ldexp(size_, -40), first);
  cells_ = delaunay_cells(sites_.points, second);
  monitor_.step(0.5);
  place_cells();
  merge_coincident();
  add_facets();
}

/// Visits every Delaunay edge between two regular sites: its ring of cells is a Voronoi facet.
void Axis::add_facets() {
  std::vector<std::int32_t> ring, apexes;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (i % 4096 == 0) monitor_.step(0.7 + 0.2 * static_cast<double>(i) / static_cast<double>(cells_.size()));
    const DelaunayCell& first = cells_[i];
    for (std::size_t a = 0; a < 3; ++a) {
      if (sites_.faces_of(at(first.corners[a])).empty()) continue;
      for (std::size_t b = a + 1; b < 4; ++b) {
        const std::int32_t w0 = first.corners[a], w1 = first.corners[b];
        if (w1 == infinite || sites_.faces_of(at(w1)).empty()) continue;
        ring.clear();
        apexes.clear();
        // Leave every cell through the triangle of the edge and `ahead`, away from `behind`.
        std::size_t rest[2], m = 0;
        for (std::size_t k = 0; k < 4; ++k) {
          if (k != a && k != b) rest[m++] = k;
        }
        std::int32_t cell = static_cast<std::int32_t>(i);
        std::int32_t behind = first.corners[rest[0]], ahead = first.corners[rest[1]];
        bool lowest = true;
        do {
          ring.push_back(cell);
          apexes.push_back(ahead);
          const DelaunayCell& here = cells_[at(cell)];
          std::size_t k = 0;
          while (here.corners[k] != behind) ++k;
          cell = here.neighbors[k];
          if (cell < static_cast<std::int32_t>(i)) {
            lowest = false;
            break;
          }
          const DelaunayCell& next = cells_[at(cell)];
          for (k = 0; next.corners[k] == w0 || next.corners[k] == w1 || next.corners[k] == ahead;) ++k;
          behind = ahead;
          ahead = next.corners[k];
        } while (cell != static_cast<std::int32_t>(i));
        if (lowest) add_facet(w0, w1, ring, apexes);
      }
    }
  }
}

/// Keeps what lies in R of the facet between w0 and w1. ring[k] and ring[k + 1] are the ends of the Voronoi
/// edge of w0, w1 and apexes[k].
void Axis::add_facet(std::int32_t w0, std::int32_t w1, std::span<const std::int32_t> ring,
                     std::span<const std::int32_t> apexes) {
  const std::size_t n = ring.size();
  const auto vertex = [&](std::size_t k) { return vertices_[at(ring[k % n])]; };
  // Appends the ball centres on the Voronoi edge behind ring[edge], beginning at its end ring[from]: those of
  // the balls its three sites share. One is where the edge leaves R, unless its end inside R is.
  const auto pass = [&](std::size_t edge, std::size_t from, Polygon& polygon) {
    if (apexes[edge % n] == infinite) return;
    const std::array<std::int32_t, 3> sites{w0, w1, apexes[edge % n]};
    const std::size_t before = polygon.size();
    for (const std::int32_t ball : sites_.balls_of(at(w0))) {
      if (ball == vertex(edge).name || ball == vertex(edge + 1).name) continue;
      if (all_on(ball, sites)) polygon.push_back(ball);
    }
    if (polygon.size() - before < 2) return;
    const VoronoiVertex first = vertex(from);
    const Vec3 start = first.place == Place::on ? center(first.name) : positions_[at(ring[from % n])];
    std::sort(polygon.begin() + static_cast<std::ptrdiff_t>(before), polygon.end(),
              [&](std::int32_t a, std::int32_t b) {
                const double da = squared_distance(center(a), start), db = squared_distance(center(b), start);
                return da != db ? da < db : a < b;
              });
  };

  std::size_t start = 0;  // behind a vertex outside R, if there is one
  while (start < n && vertex(start + n - 1).place != Place::out) ++start;
  if (start == n) {
    Polygon polygon;
    for (std::size_t k = 0; k < n; ++k) {
      polygon.push_back(vertex(k).name);
      pass(k, k, polygon);
    }
    return keep_inside(std::move(polygon), w0, w1, false);
  }
  for (std::size_t k = start; k < start + n; ++k) {
    if (vertex(k).place == Place::out) continue;
    Polygon polygon;
    pass(k + n - 1, k, polygon);
    std::reverse(polygon.begin(), polygon.end());
    for (; vertex(k).place != Place::out; ++k) {
      polygon.push_back(vertex(k).name);
      pass(k, k, polygon);
    }
    keep_inside(std::move(polygon), w0, w1, true);
  }
}

/// Adds a piece of the facet between w0 and w1 with no corner outside R. `cut`: the boundary of R cut it
/// between the last corner and the first.
void Axis::keep_inside(Polygon polygon, std::int32_t w0, std::int32_t w1, bool cut) {
  const auto is_ball = [this](std::int32_t name) { return name < balls(); };
  const auto depth_of = [&](Vec3 x) {  // the site that sees x more clearly decides
    const double d0 = depth(w0, x), d1 = depth(w1, x);
    return std::abs(d0) > std::abs(d1) ? d0 : d1;
  };
  if (std::count_if(polygon.begin(), polygon.end(), is_ball) < 2)
    return add_polygon(polygon, AxisKind::voronoi);

  std::vector<Edge> shared;  // edges between triangles of w0 and of w1
  for (const auto& f0 : sites_.faces_of(at(w0))) {
    for (const auto& f1 : sites_.faces_of(at(w1))) {
      const auto &t0 = complex_.triangles[at(f0.triangle)], &t1 = complex_.triangles[at(f1.triangle)];
      Polygon common;
      std::set_intersection(t0.begin(), t0.end(), t1.begin(), t1.end(), std::back_inserter(common));
      if (common.size() == 2) shared.push_back({common[0], common[1]});
    }
  }
  const auto is_shared = [&shared](std::int32_t a, std::int32_t b) {
    return std::find(shared.begin(), shared.end(), Edge{std::min(a, b), std::max(a, b)}) != shared.end();
  };
  // Between two centres the boundary of R follows shared edges: one, unless w0 and w1 have several triangles.
  Polygon corners;
  bool wall = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const bool last = k + 1 == polygon.size();
    const std::int32_t a = polygon[k], b = polygon[last ? 0 : k + 1];
    corners.push_back(a);
    if (a == b || !is_ball(a) || !is_ball(b)) continue;
    if (is_shared(a, b)) {
      wall = true;
    } else if (shared.size() > 1 && ((last && cut) || depth_of(0.5 * (center(a) + center(b))) <= same_)) {
      const Polygon path = path_between(a, b, shared);
      corners.insert(corners.end(), path.begin(), path.end());
      wall = wall || !path.empty();
    }
  }
  if (std::all_of(corners.begin(), corners.end(), is_ball)) {
    Polygon centers = corners;
    std::sort(centers.begin(), centers.end());
    centers.erase(std::unique(centers.begin(), centers.end()), centers.end());
    if (centers.size() < 3) return;
    Vec3 centroid;
    for (const std::int32_t b : centers) centroid = centroid + center(b);
    // A facet may lie in the boundary of R: the polytope outside it is then flat.
    if (depth_of((1.0 / static_cast<double>(centers.size())) * centroid) < -same_) return;
  }
  add_polygon(corners, wall ? AxisKind::wall : AxisKind::voronoi);
}

/// Adds the loops of a closed chain of names: equal neighbours are one corner, and a name that comes back
/// splits the chain.
void Axis::add_polygon(const Polygon& polygon, AxisKind kind) {
  Polygon chain;
  for (const std::int32_t name : polygon) {
    const auto before = std::find(chain.begin(), chain.end(), name);
    if (before == chain.end()) {
      chain.push_back(name);
      continue;
    }
    if (chain.end() - before >= 3) pieces_.push_back({Polygon(before, chain.end()), kind});
    chain.erase(before + 1, chain.end());
  }
  if (chain.size() >= 3) pieces_.push_back({std::move(chain), kind});
}

void Axis::add_singular_part() {
  std::vector<bool> has_triangle(complex_.edges.size(), false), has_edge(complex_.centers.size(), false);
  std::vector<bool> has_tetrahedron(complex_.triangles.size(), false);
  const auto skip = []<std::size_t N>(const std::array<std::int32_t, N>& simplex, std::size_t left_out) {
    std::array<std::int32_t, N - 1> face{};
    for (std::size_t k = 0, m = 0; k < N; ++k) {
      if (k != left_out) face[m++] = simplex[k];
    }
    return face;
  };
  const auto index = [](const auto& all, const auto& simplex) {
    return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), simplex) - all.begin());
  };
  for (const auto& t : complex_.tetrahedra) {
    look_(64);
    for (std::size_t k = 0; k < 4; ++k) has_tetrahedron[index(complex_.triangles, skip(t, k))] = true;
  }
  for (std::size_t i = 0; i < complex_.triangles.size(); ++i) {
    look_(64);
    const auto& t = complex_.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) has_triangle[index(complex_.edges, skip(t, k))] = true;
    if (!has_tetrahedron[i]) pieces_.push_back({{t[0], t[1], t[2]}, AxisKind::singular});
  }
  for (std::size_t i = 0; i < complex_.edges.size(); ++i) {
    for (const std::int32_t b : complex_.edges[i]) has_edge[at(b)] = true;
    if (!has_triangle[i]) edges_.push_back(complex_.edges[i]);
  }
  for (const std::int32_t b : complex_.vertices) {
    if (!has_edge[at(b)]) isolated_.push_back(b);
  }
}

/// Numbers the vertices in the order of their names and the polygons in the order of their corners.
MedialAxis Axis::finish() {
  std::vector<std::int32_t> index(complex_.centers.size() + cells_.size(), -1);
  for (const Piece& piece : pieces_) {
    look_(16);
    for (const std::int32_t name : piece.corners) index[at(name)] = 0;
  }
  for (const auto& edge : edges_) {
    for (const std::int32_t name : edge) index[at(name)] = 0;
  }
  for (const std::int32_t name : isolated_) index[at(name)] = 0;
  std::vector<Vec3> vertices;
  std::vector<double> radii;
  for (std::size_t name = 0; name < index.size(); ++name) {
    look_(8);
    if (index[name] < 0) continue;
    index[name] = static_cast<std::int32_t>(vertices.size());
    if (name < complex_.centers.size()) {
      vertices.push_back(complex_.centers[name]);
      radii.push_back(std::sqrt(std::max(0.0, complex_.weights[name])));
    } else {
      const std::size_t cell = name - complex_.centers.size();
      vertices.push_back(positions_[cell]);
      Vec3 site = sites_.points[at(cells_[cell].corners[0])];
      for (const std::int32_t w : cells_[cell].corners) site = std::min(site, sites_.points[at(w)], before);
      radii.push_back(distance(positions_[cell], site));
    }
  }
  for (Piece& piece : pieces_) {
    look_(16);
    Polygon& p = piece.corners;
    for (std::int32_t& corner : p) corner = index[at(corner)];
    std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
    if (p.back() < p[1]) std::reverse(p.begin() + 1, p.end());
  }
  monitor_.step(0.93);
  std::sort(pieces_.begin(), pieces_.end(), [this](const Piece& a, const Piece& b) {
    look_(8);
    return a.corners != b.corners ? a.corners < b.corners : a.kind < b.kind;
  });
  monitor_.step(0.96);
  for (auto& edge : edges_) edge = {index[at(edge[0])], index[at(edge[1])]};

  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> corners;
  std::vector<std::uint8_t> kinds;
  for (const Piece& piece : pieces_) {
    look_(16);
    corners.insert(corners.end(), piece.corners.begin(), piece.corners.end());
    offsets.push_back(static_cast<std::int64_t>(corners.size()));
    kinds.push_back(static_cast<std::uint8_t>(piece.kind));
  }
  MedialAxis axis;
  axis.vertices = std::move(vertices);
  axis.radii = std::move(radii);
  axis.edges = std::move(edges_);
  axis.polygon_offsets = std::move(offsets);
  axis.polygon_vertices = std::move(corners);
  axis.polygon_kinds = std::move(kinds);
  return with_sheets(std::move(axis), monitor_);
}

}  // namespace

MedialAxis medial_axis(const SimplicialComplex& complex, const MedialAxisOptions& options, Monitor& monitor) {
  MedialAxis axis = Axis(complex, monitor).run();
  const std::int64_t expected = complex.euler_characteristic();
  const std::int64_t found = axis_topology(axis).euler_characteristic;
  if (found != expected) {
    const std::string cause = "the Euler characteristic of the axis is " + std::to_string(found) +
                              ", that of the union is " + std::to_string(expected);
    const std::string hint = "enlarge the balls before the alpha-shape is taken (node Enlarge)";
    if (options.on_mismatch == AxisMismatch::error) throw InputError(cause, hint);
    monitor.warn(cause + "; " + hint);
  }
  monitor.step(1);
  return axis;
}

}  // namespace ballflow::geometry
