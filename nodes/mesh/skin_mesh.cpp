#include "mesh/skin_mesh.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Skin_surface_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/index.hpp"
#include "mesh/exact_mesh.hpp"
#include "power/union_vertices.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Weighted = Kernel::Weighted_point_3;
using Skin = CGAL::Skin_surface_3<CGAL::Skin_surface_traits_3<Kernel>>;
using Quadric = Skin::Quadratic_surface;
using Mixed = Skin::TMC;

// CGAL has lengths of its own (1 beside the box, for one): balls are scaled so that the longest edge of their
// box is between this and half of it.
constexpr double extent = 4096;

/// The corners of a simplex, in an order that does not depend on addresses: rounding depends on it.
std::vector<Weighted> corners_of(const Skin::Simplex& simplex) {
  std::vector<Weighted> corners;
  if (simplex.dimension() == 0) {
    corners.push_back(Skin::Vertex_handle(simplex)->point());
  } else if (simplex.dimension() == 1) {
    const Skin::Edge e = simplex;
    corners = {e.first->vertex(e.second)->point(), e.first->vertex(e.third)->point()};
  } else if (simplex.dimension() == 2) {
    const Skin::Facet f = simplex;
    for (int k = 1; k < 4; ++k) corners.push_back(f.first->vertex((f.second + k) & 3)->point());
  } else {
    const Skin::Cell_handle c = simplex;
    for (int k = 0; k < 4; ++k) corners.push_back(c->vertex(k)->point());
  }
  std::sort(corners.begin(), corners.end(), [](const Weighted& a, const Weighted& b) {
    return a.point() != b.point() ? a.point() < b.point() : a.weight() < b.weight();
  });
  return corners;
}

Vec3 center_of(const std::vector<Weighted>& c) {
  const auto center = Kernel().construct_weighted_circumcenter_3_object();
  const Point p = c.size() == 1   ? c[0].point()
                  : c.size() == 2 ? center(c[0], c[1])
                  : c.size() == 3 ? center(c[0], c[1], c[2])
                                  : center(c[0], c[1], c[2], c[3]);
  return {p.x(), p.y(), p.z()};
}
Quadric quadric_of(const std::vector<Weighted>& c, double shrink) {
  if (c.size() == 1) return {c[0], shrink};
  if (c.size() == 2) return {c[0], c[1], shrink};
  if (c.size() == 3) return {c[0], c[1], c[2], shrink};
  return {c[0], c[1], c[2], c[3], shrink};
}

/// A corner of the mixed complex, and the function there that is negative inside the surface. It is quadratic
/// along every edge, and its gradient is continuous.
struct Corner {
  Vec3 place;
  double value;
  Vec3 gradient;
};

Corner corner_of(const Skin::Vertex_info& anchor, double shrink) {
  const std::vector<Weighted> corners = corners_of(anchor.first);
  Corner corner;
  corner.place = (1 - shrink) * center_of(corners) + shrink * center_of(corners_of(anchor.second));
  // The centre of this simplex is in it, so nothing is badly conditioned.
  Quadric quadric = quadric_of(corners, shrink);
  const Point p(corner.place.x, corner.place.y, corner.place.z);
  corner.value = quadric.value(p);
  const Kernel::Vector_3 g = quadric.gradient(p);
  corner.gradient = {g.x(), g.y(), g.z()};
  return corner;
}

/// Where the surface crosses the edge from a corner inside to one that is not.
Vec3 crossing(const Corner& in, const Corner& out) {
  const Vec3 way = out.place - in.place;
  const double slope = dot(in.gradient, way), bend = out.value - in.value - slope;
  // The root of value + slope t + bend t^2 between 0 and 1; there is one, and the value at 0 is negative.
  const double root = std::sqrt(std::max(0.0, slope * slope - 4 * bend * in.value));
  const double t = slope >= 0 ? -2 * in.value / (slope + root) : (root - slope) / (2 * bend);
  // Not in the corner itself, where other edges begin.
  constexpr double least = 1e-9;
  return in.place + (t >= least ? std::min(t, 1 - least) : least) * way;
}

class Marching {
 public:
  Marching(const Mixed& mixed, double shrink, std::size_t most_faces, Monitor& monitor)
      : most_faces_(most_faces), monitor_(monitor) {
    Lookout look(monitor);
    std::unordered_map<const void*, std::int32_t> place;
    for (auto v = mixed.finite_vertices_begin(); v != mixed.finite_vertices_end(); ++v) {
      look(256);
      place.emplace(&*v, static_cast<std::int32_t>(corners_.size()));
      corners_.push_back(corner_of(v->info(), shrink));
    }
    for (auto c = mixed.finite_cells_begin(); c != mixed.finite_cells_end(); ++c) {
      look(32);
      std::array<std::int32_t, 4> ids{};
      for (int k = 0; k < 4; ++k) ids[static_cast<std::size_t>(k)] = place.at(&*c->vertex(k));
      cut(ids);
    }
  }

  TriangleMesh mesh() {
    // By place, and triangles from their first corner: what is left of the order of the complex.
    std::vector<std::size_t> order(vertices_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return before(vertices_[a], vertices_[b]); });
    std::vector<std::int32_t> rank(order.size());
    std::vector<Vec3> vertices;
    for (const std::size_t v : order) {
      rank[v] = static_cast<std::int32_t>(vertices.size());
      vertices.push_back(vertices_[v]);
    }
    for (Triangle& t : triangles_) {
      for (std::int32_t& v : t) v = rank[static_cast<std::size_t>(v)];
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    }
    std::sort(triangles_.begin(), triangles_.end());
    return {std::move(vertices), std::move(triangles_)};
  }

 private:
  const Corner& corner(std::int32_t i) const { return corners_[static_cast<std::size_t>(i)]; }
  bool inside(std::int32_t i) const { return corner(i).value < 0; }

  std::int32_t vertex(std::int32_t in, std::int32_t out) {
    const auto key = static_cast<std::uint64_t>(in) << 32 | static_cast<std::uint64_t>(out);
    const auto [known, is_new] =
        on_edge_.try_emplace(key, index_of(vertices_.size(), "vertices of the mesh"));
    if (is_new) vertices_.push_back(crossing(corner(in), corner(out)));
    return known->second;
  }

  void add(std::int32_t p, std::int32_t q, std::int32_t r, bool positive) {
    if (!positive) std::swap(q, r);
    triangles_.push_back({p, q, r});
    if (triangles_.size() > most_faces_) throw too_many_faces(static_cast<std::int64_t>(most_faces_));
  }

  /// Triangles between the corners inside and the others of a positively oriented tetrahedron.
  void cut(std::array<std::int32_t, 4> c) {
    bool positive = true;
    std::size_t inner = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!inside(c[k])) continue;
      if (k != inner) {
        std::swap(c[k], c[inner]);
        positive = !positive;
      }
      ++inner;
    }
    if (inner == 1) add(vertex(c[0], c[1]), vertex(c[0], c[2]), vertex(c[0], c[3]), positive);
    if (inner == 3) add(vertex(c[0], c[3]), vertex(c[2], c[3]), vertex(c[1], c[3]), !positive);
    if (inner != 2) return;
    const std::array<std::int32_t, 4> ring{vertex(c[0], c[2]), vertex(c[0], c[3]), vertex(c[1], c[3]),
                                           vertex(c[1], c[2])};
    const auto at = [&](std::size_t k) { return vertices_[static_cast<std::size_t>(ring[k % 4])]; };
    // The shorter diagonal; of equal ones that which begins first.
    const double one = squared_distance(at(0), at(2)), other = squared_distance(at(1), at(3));
    const auto first = [&](std::size_t k) { return before(at(k), at(k + 2)) ? at(k) : at(k + 2); };
    const std::size_t from = one < other || (one == other && before(first(0), first(1))) ? 0 : 1;
    for (const std::size_t k : {from, from + 2}) add(ring[k], ring[(k + 1) % 4], ring[(k + 2) % 4], positive);
  }

  const std::size_t most_faces_;
  Monitor& monitor_;
  std::vector<Corner> corners_;
  std::unordered_map<std::uint64_t, std::int32_t> on_edge_;
  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;
};

}  // namespace

TriangleMesh skin_mesh(const Balls& balls, double shrink, std::size_t most_faces, Monitor& monitor) {
  int exponent = 0;
  std::frexp(bounding_box(balls).longest_edge() / extent, &exponent);
  const double scale = std::ldexp(1.0, -exponent);
  std::vector<Weighted> weighted;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 c = scale * balls.centers[i];
    weighted.emplace_back(Point(c.x, c.y, c.z), std::pow(scale * balls.radii[i], 2));
  }
  monitor.step(0);
  Skin skin(weighted.begin(), weighted.end(), shrink);
  monitor.step(0.8);
  TriangleMesh mesh = Marching(skin.triangulated_mixed_complex(), shrink, most_faces, monitor).mesh();
  std::vector<Vec3> vertices;
  for (const Vec3 v : mesh.vertices) vertices.push_back(1 / scale * v);
  return {std::move(vertices), std::move(mesh.triangles)};
}

}  // namespace ballflow::geometry
