#include "power/grown_balls.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Fixed_alpha_shape_3.h>
#include <CGAL/Fixed_alpha_shape_cell_base_3.h>
#include <CGAL/Fixed_alpha_shape_vertex_base_3.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "exact/spatial_order.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using VertexBase = CGAL::Fixed_alpha_shape_vertex_base_3<
    Kernel, CGAL::Triangulation_vertex_base_with_info_3<std::int32_t, Kernel,
                                                        CGAL::Regular_triangulation_vertex_base_3<Kernel>>>;
using CellBase = CGAL::Fixed_alpha_shape_cell_base_3<Kernel, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Triangulation =
    CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using AlphaShape = CGAL::Fixed_alpha_shape_3<Triangulation>;

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

template <class Simplices>
void sort(Simplices& simplices) {
  for (auto& simplex : simplices) std::sort(simplex.begin(), simplex.end());
  std::sort(simplices.begin(), simplices.end());
}

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
  const AlphaShape shape(triangulation, 0);
  monitor.step(0.9);

  std::vector<std::int32_t> vertices;
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
  for (auto v = shape.finite_vertices_begin(); v != shape.finite_vertices_end(); ++v) {
    if (shape.classify(v) != AlphaShape::EXTERIOR) vertices.push_back(v->info());
  }
  for (auto e = shape.finite_edges_begin(); e != shape.finite_edges_end(); ++e) {
    if (shape.classify(*e) != AlphaShape::EXTERIOR)
      edges.push_back({e->first->vertex(e->second)->info(), e->first->vertex(e->third)->info()});
  }
  for (auto f = shape.finite_facets_begin(); f != shape.finite_facets_end(); ++f) {
    if (shape.classify(*f) == AlphaShape::EXTERIOR) continue;
    const auto ball = [&](int k) { return f->first->vertex((f->second + k) & 3)->info(); };
    triangles.push_back({ball(1), ball(2), ball(3)});
  }
  for (Triangulation::Cell_handle c : shape.finite_cell_handles()) {
    if (shape.classify(c) == AlphaShape::EXTERIOR) continue;
    tetrahedra.push_back(
        {c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()});
  }
  std::sort(vertices.begin(), vertices.end());
  sort(edges);
  sort(triangles);
  sort(tetrahedra);

  SimplicialComplex complex;
  complex.vertex_classes = std::vector<std::uint8_t>(vertices.size());
  complex.edge_classes = std::vector<std::uint8_t>(edges.size());
  complex.triangle_classes = std::vector<std::uint8_t>(triangles.size());
  complex.centers = std::move(centers);
  complex.weights = std::move(weights);
  complex.vertices = std::move(vertices);
  complex.edges = std::move(edges);
  complex.triangles = std::move(triangles);
  complex.tetrahedra = std::move(tetrahedra);
  monitor.step(1);
  return complex;
}

}  // namespace ballflow::geometry
