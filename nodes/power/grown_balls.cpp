#include "power/grown_balls.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "exact/spatial_order.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase =
    CGAL::Regular_triangulation_cell_base_3<Kernel, CGAL::Triangulation_cell_base_with_info_3<bool, Kernel>,
                                            CGAL::Discard_hidden_points>;  // in the complex
using Triangulation =
    CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

/// The place of the last bit that is set: value = odd number * 2^place. The value is not 0.
int last_bit(double value) {
  int exponent = 0;
  const double digits = std::ldexp(std::abs(std::frexp(value, &exponent)), 53);
  return exponent - 53 + std::countr_zero(static_cast<std::uint64_t>(digits));
}

std::uint64_t mixed(std::uint64_t x) {  // splitmix64
  x += 0x9e3779b97f4a7c15;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
  x = (x ^ x >> 27) * 0x94d049bb133111eb;
  return x ^ x >> 31;
}

/// 2^exponent.
Kernel::Exact_kernel::FT power_of_two(long exponent) {
  Kernel::Exact_kernel::FT out(1), factor(exponent < 0 ? 0.5 : 2.0);
  for (auto rest = static_cast<unsigned long>(std::abs(exponent)); rest > 0; rest >>= 1) {
    if ((rest & 1) != 0) out = out * factor;
    factor = factor * factor;
  }
  return out;
}

template <std::size_t N>
std::array<std::int32_t, N> sorted(std::array<std::int32_t, N> simplex) {
  std::sort(simplex.begin(), simplex.end());
  return simplex;
}

/// The simplices of the zero alpha-shape, from cells down to vertices: one is in it when a coface is, or when
/// it is a Gabriel simplex whose orthogonal sphere has a squared radius <= 0.
class Complex {
 public:
  Complex(Triangulation& triangulation, Monitor& monitor) : triangulation_(triangulation), look_(monitor) {
    add_tetrahedra();
    add_triangles();
    add_edges();
    add_vertices();
  }

  std::vector<std::int32_t> vertices;
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::array<std::int32_t, 4>> tetrahedra;

 private:
  static constexpr std::size_t exact_work = 1 << 14;  // of a predicate, in elements visited

  template <class... Vertices>
  bool meet(const Vertices&... v) const {
    return triangulation_.geom_traits().compare_weighted_squared_radius_3_object()(
               v->point()..., Kernel::FT(0)) != CGAL::LARGER;
  }
  template <class Simplices>
  void order(Simplices& simplices) {
    std::sort(simplices.begin(), simplices.end(), [this](const auto& a, const auto& b) {
      look_(4);
      return a < b;
    });
    simplices.erase(std::unique(simplices.begin(), simplices.end()), simplices.end());
  }

  void add_tetrahedra() {
    for (auto c = triangulation_.all_cells_begin(); c != triangulation_.all_cells_end(); ++c) {
      look_(exact_work);
      c->info() =
          !triangulation_.is_infinite(c) && meet(c->vertex(0), c->vertex(1), c->vertex(2), c->vertex(3));
      if (!c->info()) continue;
      tetrahedra.push_back(sorted<4>(
          {c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()}));
    }
    order(tetrahedra);
  }
  void add_triangles() {
    for (auto f = triangulation_.finite_facets_begin(); f != triangulation_.finite_facets_end(); ++f) {
      look_(exact_work);
      const auto vertex = [&](int k) { return f->first->vertex((f->second + k) & 3); };
      const bool face = f->first->info() || f->first->neighbor(f->second)->info();
      if (face || (meet(vertex(1), vertex(2), vertex(3)) && triangulation_.is_Gabriel(*f)))
        triangles.push_back(sorted<3>({vertex(1)->info(), vertex(2)->info(), vertex(3)->info()}));
    }
    order(triangles);
  }
  void add_edges() {
    for (const auto& t : triangles) {
      look_(8);
      for (const auto& [a, b] : {std::array{t[0], t[1]}, std::array{t[0], t[2]}, std::array{t[1], t[2]}})
        edges.push_back({a, b});
    }
    order(edges);
    const std::size_t sides = edges.size();
    for (auto e = triangulation_.finite_edges_begin(); e != triangulation_.finite_edges_end(); ++e) {
      look_(exact_work);
      const auto u = e->first->vertex(e->second), v = e->first->vertex(e->third);
      const std::array<std::int32_t, 2> edge = sorted<2>({u->info(), v->info()});
      if (std::binary_search(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(sides), edge))
        continue;
      if (meet(u, v) && triangulation_.is_Gabriel(*e)) edges.push_back(edge);
    }
    order(edges);
  }
  void add_vertices() {
    for (const auto& [a, b] : edges) {
      vertices.push_back(a);
      vertices.push_back(b);
    }
    order(vertices);
    const std::size_t ends = vertices.size();
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v) {
      look_(exact_work);
      if (std::binary_search(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(ends),
                             v->info()))
        continue;
      if (triangulation_.is_Gabriel(v)) vertices.push_back(v->info());  // the ball's weight is positive
    }
    order(vertices);
  }

  Triangulation& triangulation_;
  Lookout look_;
};

}  // namespace

GrownBalls::GrownBalls(std::span<const Vec3> centers, std::span<const double> weights)
    : centers_(centers), weights_(weights) {
  int largest = std::numeric_limits<int>::min(), last = std::numeric_limits<int>::max();
  const auto look = [&](double value, int roots) {
    if (value == 0) return;
    int exponent = 0;
    std::frexp(value, &exponent);
    largest = std::max(largest, roots == 2 ? (exponent + 1) >> 1 : exponent);
    last = std::min(last, roots == 2 ? last_bit(value) >> 1 : last_bit(value));
  };
  for (std::size_t i = 0; i < centers.size(); ++i) {
    for (const double c : {centers[i].x, centers[i].y, centers[i].z}) look(c, 1);
    look(weights[i], 2);
  }
  if (largest < last) return;  // nothing but zeros
  magnitude_ = largest;
  unit_ = 2 * largest - 8L * (largest - last) - 96;
}

double GrownBalls::growth(std::int32_t ball) const {
  std::uint64_t mark = 0;
  const Vec3 c = center(ball);
  for (const double value : {c.x, c.y, c.z, weight(ball)})
    mark = mixed(mark ^ std::bit_cast<std::uint64_t>(value + 0.0));
  return 0x1p32 + static_cast<double>(mark >> 32);
}

LongNumber GrownBalls::grown_weight(std::int32_t ball, long bits) const {
  return LongNumber(weight(ball), bits) + LongNumber::scaled(growth(ball), unit_, bits);
}

SimplicialComplex grown_complex(const GrownBalls& balls, Monitor& monitor) {
  std::vector<Vec3> centers(balls.size());
  std::vector<double> weights(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    centers[i] = balls.center(static_cast<std::int32_t>(i));
    weights[i] = balls.weight(static_cast<std::int32_t>(i));
  }
  const Kernel::Exact_kernel::FT unit = power_of_two(balls.unit());
  Triangulation triangulation;
  Triangulation::Cell_handle hint;
  std::size_t done = 0;
  for (const std::int32_t ball : spatial_order(centers)) {
    if (done++ % 64 == 0) monitor.step(0.7 * static_cast<double>(done) / static_cast<double>(centers.size()));
    const Vec3 c = balls.center(ball);
    const Kernel::Exact_kernel::FT weight(Kernel::Exact_kernel::FT(balls.weight(ball)) +
                                          Kernel::Exact_kernel::FT(balls.growth(ball)) * unit);
    const auto vertex = triangulation.insert(
        Kernel::Weighted_point_3(Kernel::Point_3(c.x, c.y, c.z), Kernel::FT(weight)), hint);
    if (vertex == nullptr) continue;  // hidden
    vertex->info() = ball;
    hint = vertex->cell();
  }
  if (triangulation.dimension() < 3) throw InputError("the centres of the balls lie in a plane", "");
  monitor.step(0.7);
  Complex found(triangulation, monitor);

  SimplicialComplex complex;
  complex.vertex_classes = std::vector<std::uint8_t>(found.vertices.size());
  complex.edge_classes = std::vector<std::uint8_t>(found.edges.size());
  complex.triangle_classes = std::vector<std::uint8_t>(found.triangles.size());
  complex.centers = std::move(centers);
  complex.weights = std::move(weights);
  complex.vertices = std::move(found.vertices);
  complex.edges = std::move(found.edges);
  complex.triangles = std::move(found.triangles);
  complex.tetrahedra = std::move(found.tetrahedra);
  monitor.step(1);
  return complex;
}

}  // namespace ballflow::geometry
