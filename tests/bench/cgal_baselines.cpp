#include "cgal_baselines.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Fixed_alpha_shape_3.h>
#include <CGAL/Fixed_alpha_shape_cell_base_3.h>
#include <CGAL/Fixed_alpha_shape_vertex_base_3.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>

#include <vector>

namespace ballflow::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

using VertexBase =
    CGAL::Fixed_alpha_shape_vertex_base_3<Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Fixed_alpha_shape_cell_base_3<
    Kernel, CGAL::Regular_triangulation_cell_base_3<Kernel, CGAL::Triangulation_cell_base_3<Kernel>,
                                                    CGAL::Discard_hidden_points>>;
using Triangulation =
    CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

}  // namespace

std::size_t delaunay(std::span<const geometry::Vec3> points) {
  std::vector<Kernel::Point_3> sites;
  sites.reserve(points.size());
  for (const auto& p : points) sites.emplace_back(p.x, p.y, p.z);
  return CGAL::Delaunay_triangulation_3<Kernel>(sites.begin(), sites.end()).number_of_finite_cells();
}

struct RegularTriangulation::Impl {
  Triangulation triangulation;
};

RegularTriangulation::RegularTriangulation(const geometry::Balls& balls) : impl_(std::make_unique<Impl>()) {
  std::vector<Kernel::Weighted_point_3> sites;
  sites.reserve(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const auto& c = balls.centers[i];
    sites.emplace_back(Kernel::Point_3(c.x, c.y, c.z), balls.radii[i] * balls.radii[i]);
  }
  impl_->triangulation.insert(sites.begin(), sites.end());
}
RegularTriangulation::~RegularTriangulation() = default;

std::size_t RegularTriangulation::cells() const { return impl_->triangulation.number_of_finite_cells(); }

std::size_t RegularTriangulation::fixed_alpha_shape() {
  using AlphaShape = CGAL::Fixed_alpha_shape_3<Triangulation>;
  const AlphaShape shape(impl_->triangulation, 0);
  std::size_t inside = 0;
  for (auto cell = shape.finite_cells_begin(); cell != shape.finite_cells_end(); ++cell) {
    if (shape.classify(cell) == AlphaShape::INTERIOR) ++inside;
  }
  return inside;
}

}  // namespace ballflow::bench
