#include "axis/grown_sites.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "axis/delaunay_cells_of.hpp"
#include "exact/spatial_order.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

template <class Number>
struct Vector {
  Number x, y, z;
};
template <class Number>
Vector<Number> minus(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Number>
Vector<Number> plus(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Number>
Vector<Number> times(const Number& s, const Vector<Number>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Number>
Vector<Number> cross_of(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Number>
Number dot_of(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Number>
Number volume(const Vector<Number>& a, const Vector<Number>& b, const Vector<Number>& c) {
  return dot_of(cross_of(a, b), c);
}

template <class Number>
Number orientation_of(const std::array<Vector<Number>, 4>& p) {
  return volume(minus(p[1], p[0]), minus(p[2], p[0]), minus(p[3], p[0]));
}
/// Positive for p[4] inside the sphere through the others, if these are positively oriented.
template <class Number>
Number sphere_side_of(const std::array<Vector<Number>, 5>& p) {
  const Vector<Number> a = minus(p[0], p[4]), b = minus(p[1], p[4]), c = minus(p[2], p[4]),
                       d = minus(p[3], p[4]);
  const Vector<Number> ab = cross_of(a, b), cd = cross_of(c, d);
  const Number abc = dot_of(ab, c), abd = dot_of(ab, d), acd = dot_of(a, cd), bcd = dot_of(b, cd);
  return (dot_of(c, c) * abd - dot_of(d, d) * abc) + (dot_of(a, a) * bcd - dot_of(b, b) * acd);
}
/// The circumcentre is p[0] + offset / scale.
template <class Number>
std::pair<Vector<Number>, Number> circumcenter_of(const std::array<Vector<Number>, 4>& p) {
  const Vector<Number> a = minus(p[1], p[0]), b = minus(p[2], p[0]), c = minus(p[3], p[0]);
  const Vector<Number> bc = cross_of(b, c), ca = cross_of(c, a), ab = cross_of(a, b);
  const Number det = dot_of(a, bc);
  return {plus(plus(times(dot_of(a, a), bc), times(dot_of(b, b), ca)), times(dot_of(c, c), ab)), det + det};
}

template <class Place>
Vector<LongNumber> vector(const Place& p) {
  return {p.x, p.y, p.z};
}

// --- CGAL's triangulation, with our decisions.

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Site : Epick::Point_3 {
  Site() = default;
  Site(Vec3 p, std::int32_t number) : Epick::Point_3(p.x, p.y, p.z), site(number) {}
  std::int32_t site = -1;
};

struct Traits : Epick {
  using Point_3 = Site;
  struct Construct_point_3 {
    const Site& operator()(const Site& p) const { return p; }
  };
  struct Compare_xyz_3 {  // any order of points will do
    CGAL::Comparison_result operator()(const Site& p, const Site& q) const {
      return p.site < q.site ? CGAL::SMALLER : p.site > q.site ? CGAL::LARGER : CGAL::EQUAL;
    }
  };
  struct Orientation_3 {
    const GrownSites* sites;
    CGAL::Orientation operator()(const Site& p, const Site& q, const Site& r, const Site& s) const {
      return static_cast<CGAL::Orientation>(sites->orientation({p.site, q.site, r.site, s.site}));
    }
  };
  struct Side_of_oriented_sphere_3 {
    const GrownSites* sites;
    CGAL::Oriented_side operator()(const Site& p, const Site& q, const Site& r, const Site& s,
                                   const Site& t) const {
      return static_cast<CGAL::Oriented_side>(
          sites->side_of_oriented_sphere({p.site, q.site, r.site, s.site, t.site}));
    }
  };

  explicit Traits(const GrownSites* of = nullptr) : sites(of) {}
  Construct_point_3 construct_point_3_object() const { return {}; }
  Compare_xyz_3 compare_xyz_3_object() const { return {}; }
  Orientation_3 orientation_3_object() const { return {sites}; }
  Side_of_oriented_sphere_3 side_of_oriented_sphere_3_object() const { return {sites}; }

  const GrownSites* sites;
};

}  // namespace

GrownSites::GrownSites(const SimplicialComplex& complex, const GrownBalls& balls, Monitor& monitor)
    : complex_(complex), balls_(balls) {
  const long longest = 8 * balls.depth() + 1024;  // a sign that is not certain then counts as 0
  for (long bits = 128; bits < longest; bits = bits * 5 / 2) lengths_.push_back(bits);
  lengths_.push_back(longest);
  PartMonitor naming(monitor, 0, 0.2);
  Box box;
  for (const ExposedSide& side : exposed_sides(complex, naming)) {
    if (!side.regular) continue;
    const auto& triangle = complex.triangles[at(side.triangle)];
    table_.balls.insert(table_.balls.end(), triangle.begin(), triangle.end());
    table_.ball_offsets.push_back(static_cast<std::int64_t>(table_.balls.size()));
    table_.faces.push_back({side.triangle, side.side});
    table_.face_offsets.push_back(static_cast<std::int64_t>(table_.faces.size()));
  }
  const std::size_t n = table_.faces.size();
  places_.resize(n + 4);
  bits_.resize(n + 4, 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 256 == 0) monitor.step(0.2 + 0.8 * static_cast<double>(i) / static_cast<double>(n));
    const auto site = static_cast<std::int32_t>(i);
    Place p = place(site, lengths_[0]);
    for (const long bits : lengths_) {
      const auto good = [&](const LongNumber& x) { return x.known_to(70, balls.magnitude() - 90); };
      if (good(p.x) && good(p.y) && good(p.z)) break;
      p = place(site, bits);
    }
    Bounds bounds{};
    const std::array<const LongNumber*, 3> coordinates{&p.x, &p.y, &p.z};
    for (std::size_t k = 0; k < 3; ++k) std::tie(bounds.low[k], bounds.high[k]) = coordinates[k]->interval();
    bounds_.push_back(bounds);
    table_.points.push_back({p.x.nearest(), p.y.nearest(), p.z.nearest()});
    box.add(table_.points.back());
  }
  for (const std::int32_t ball : complex.vertices) box.add(balls.center(ball));
  const double far = 128 * box.longest_edge();
  for (const Vec3 direction : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
    const Vec3 p = box.lower + far * direction;
    bounds_.push_back({{p.x, p.y, p.z}, {p.x, p.y, p.z}});
    table_.points.push_back(p);
    table_.ball_offsets.push_back(table_.ball_offsets.back());
    table_.face_offsets.push_back(table_.face_offsets.back());
  }
}

GrownSites::Place GrownSites::center(std::int32_t ball, long bits) const {
  const Vec3 c = balls_.center(ball);
  return {{c.x, bits}, {c.y, bits}, {c.z, bits}};
}

/// As boundary_vertex(), of the grown balls.
GrownSites::Place GrownSites::vertex_of_balls(std::int32_t site, long bits) const {
  const auto balls = table_.balls_of(at(site));
  const Vector<LongNumber> origin = vector(center(balls[0], bits));
  const Vector<LongNumber> a = minus(vector(center(balls[1], bits)), origin),
                           b = minus(vector(center(balls[2], bits)), origin);
  const LongNumber w0 = balls_.grown_weight(balls[0], bits), half(0.5, bits);
  const LongNumber alpha = half * (dot_of(a, a) + w0 - balls_.grown_weight(balls[1], bits)),
                   beta = half * (dot_of(b, b) + w0 - balls_.grown_weight(balls[2], bits));
  const Vector<LongNumber> n = cross_of(a, b);
  const LongNumber inverse = LongNumber(1, bits) / dot_of(n, n);
  const Vector<LongNumber> foot =
      times(inverse, plus(times(alpha, cross_of(b, n)), times(beta, cross_of(n, a))));
  const LongNumber height = square_root(inverse * (w0 - dot_of(foot, foot)));
  const LongNumber step = LongNumber(table_.faces_of(at(site))[0].outside, bits) * height;
  const Vector<LongNumber> p = plus(origin, plus(foot, times(step, n)));
  return {p.x, p.y, p.z};
}

GrownSites::Place GrownSites::place(std::int32_t site, long bits) const {
  if (table_.balls_of(at(site)).empty()) {
    const Vec3 p = table_.points[at(site)];
    return {{p.x, bits}, {p.y, bits}, {p.z, bits}};
  }
  std::vector<Place>& known = places_[at(site)];
  if (known.empty() || bits_[at(site)] < bits) {
    known.assign(1, vertex_of_balls(site, bits));
    bits_[at(site)] = bits;
  }
  return known[0];
}

/// How many spheres pass through all the sites, by their names.
std::int32_t GrownSites::shared_balls(std::span<const std::int32_t> sites) const {
  std::int32_t count = 0;
  for (const std::int32_t ball : table_.balls_of(at(sites[0]))) {
    count += std::all_of(sites.begin() + 1, sites.end(), [&](std::int32_t w) {
      const auto all = table_.balls_of(at(w));
      return std::find(all.begin(), all.end(), ball) != all.end();
    });
  }
  return count;
}

template <class Value>
int GrownSites::sign_of(const Value& value) const {
  for (const long bits : lengths_) {
    const int sign = value(bits).sign();
    if (sign != 0) return sign;
  }
  return 0;
}

int GrownSites::orientation(const std::array<std::int32_t, 4>& sites) const {
  if (shared_balls(sites) >= 2) return 0;
  {
    using Interval = CGAL::Interval_nt<false>;
    const CGAL::Protect_FPU_rounding<true> upwards;
    std::array<Vector<Interval>, 4> p;
    for (std::size_t k = 0; k < 4; ++k) {
      const Bounds& b = bounds_[at(sites[k])];
      p[k] = {Interval(b.low[0], b.high[0]), Interval(b.low[1], b.high[1]), Interval(b.low[2], b.high[2])};
    }
    const Interval value = orientation_of(p);
    if (value.inf() > 0) return 1;
    if (value.sup() < 0) return -1;
  }
  return sign_of([&](long bits) {
    const auto p = [&](std::size_t k) { return vector(place(sites[k], bits)); };
    return orientation_of<LongNumber>({p(0), p(1), p(2), p(3)});
  });
}

int GrownSites::side_of_oriented_sphere(const std::array<std::int32_t, 5>& sites) const {
  if (shared_balls(sites) >= 1) return 0;
  {
    using Interval = CGAL::Interval_nt<false>;
    const CGAL::Protect_FPU_rounding<true> upwards;
    std::array<Vector<Interval>, 5> p;
    for (std::size_t k = 0; k < 5; ++k) {
      const Bounds& b = bounds_[at(sites[k])];
      p[k] = {Interval(b.low[0], b.high[0]), Interval(b.low[1], b.high[1]), Interval(b.low[2], b.high[2])};
    }
    const Interval value = sphere_side_of(p);
    if (value.inf() > 0) return 1;
    if (value.sup() < 0) return -1;
  }
  return sign_of([&](long bits) {
    const auto p = [&](std::size_t k) { return vector(place(sites[k], bits)); };
    return sphere_side_of<LongNumber>({p(0), p(1), p(2), p(3), p(4)});
  });
}

int GrownSites::side_of_circumcenter(std::int32_t w, const std::array<std::int32_t, 4>& sites) const {
  const UnionVertices::Face& face = table_.faces_of(at(w))[0];
  const auto& triangle = complex_.triangles[at(face.triangle)];
  return -face.outside * sign_of([&](long bits) {
    const auto p = [&](std::size_t k) { return vector(place(sites[k], bits)); };
    const auto c = [&](std::size_t k) { return vector(center(triangle[k], bits)); };
    const auto [offset, scale] = circumcenter_of<LongNumber>({p(0), p(1), p(2), p(3)});
    const Vector<LongNumber> normal = cross_of(minus(c(1), c(0)), minus(c(2), c(0)));
    return scale * (scale * dot_of(normal, minus(p(0), c(0))) + dot_of(normal, offset));
  });
}

int GrownSites::side_of_centroid(std::int32_t w, std::span<const std::int32_t> balls) const {
  const UnionVertices::Face& face = table_.faces_of(at(w))[0];
  const auto& triangle = complex_.triangles[at(face.triangle)];
  return -face.outside * sign_of([&](long bits) {
    const auto c = [&](std::size_t k) { return vector(center(triangle[k], bits)); };
    const Vector<LongNumber> normal = cross_of(minus(c(1), c(0)), minus(c(2), c(0)));
    LongNumber sum(0, bits);
    for (const std::int32_t ball : balls) sum = sum + dot_of(normal, minus(vector(center(ball, bits)), c(0)));
    return sum;
  });
}

Vec3 GrownSites::circumcenter(const std::array<std::int32_t, 4>& sites) const {
  Vec3 out;
  for (const long bits : lengths_) {
    const auto p = [&](std::size_t k) { return vector(place(sites[k], bits)); };
    const auto [offset, scale] = circumcenter_of<LongNumber>({p(0), p(1), p(2), p(3)});
    const Vector<LongNumber> v = plus(p(0), times(LongNumber(1, bits) / scale, offset));
    out = {v.x.nearest(), v.y.nearest(), v.z.nearest()};
    const auto good = [&](const LongNumber& x) { return x.known_to(70, balls_.magnitude() - 70); };
    if (good(v.x) && good(v.y) && good(v.z)) break;
  }
  return out;
}

/// |v - a| < |v - b| where (b - a) (2 v - a - b) < 0.
bool GrownSites::nearer(std::int32_t a, std::int32_t b, const std::array<std::int32_t, 4>& sites) const {
  const int side = sign_of([&](long bits) {
    const auto p = [&](std::size_t k) { return vector(place(sites[k], bits)); };
    const auto [offset, scale] = circumcenter_of<LongNumber>({p(0), p(1), p(2), p(3)});
    const Vector<LongNumber> ca = vector(center(a, bits)), cb = vector(center(b, bits)),
                             along = minus(cb, ca);
    const Vector<LongNumber> from = minus(plus(p(0), p(0)), plus(ca, cb));
    return scale * (scale * dot_of(along, from) + LongNumber(2, bits) * dot_of(along, offset));
  });
  return side != 0 ? side < 0 : a < b;
}

std::vector<DelaunayCell> GrownSites::delaunay(Monitor& monitor) const {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Traits>;
  using Cell = CGAL::Triangulation_cell_base_with_info_3<std::int32_t, Traits>;
  using Triangulation =
      CGAL::Delaunay_triangulation_3<Traits, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
  const std::size_t n = table_.size() - 4;
  std::vector<std::int32_t> order;
  for (std::size_t i = n; i < table_.size(); ++i) order.push_back(static_cast<std::int32_t>(i));
  const auto rest = spatial_order(std::span(table_.points).first(n));
  order.insert(order.end(), rest.begin(), rest.end());
  Triangulation triangulation{Traits(this)};
  Triangulation::Cell_handle hint;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i % 16 == 0) monitor.step(0.9 * static_cast<double>(i) / static_cast<double>(order.size()));
    const auto vertex = triangulation.insert(Site(table_.points[at(order[i])], order[i]), hint);
    vertex->info() = order[i];
    hint = vertex->cell();
  }
  return delaunay_cells_of(triangulation, monitor);
}

}  // namespace ballflow::geometry
