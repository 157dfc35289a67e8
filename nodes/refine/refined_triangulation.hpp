// The Delaunay triangulation of a sample that grows, and what its balls do to a surface. Only refine.cpp and
// its parts include this: it brings CGAL along.
#pragma once

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/monitor.hpp"
#include "search/surface_tree.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {

enum class Side : std::uint8_t { unknown, inner, outer };

/// A Delaunay cell: the ball around it, and what of the surface the ball reaches through.
struct RefinedCell {
  Side side = Side::unknown;   // of the centre; cells at far-away points are outer
  bool far = false;            // it has a far-away point
  std::int32_t number = -1;    // for whoever numbers the cells
  std::int32_t triangle = -1;  // where `nearest` is
  Vec3 center;
  Vec3 nearest;       // the surface point next to the centre
  double radius = 0;  // the largest distance to its samples
  double depth = 0;   // how far it reaches to the wrong side of the surface: radius - |center - nearest|
  // From `nearest` on away from the centre to the surface again: the wall behind an outer, the slot before an
  // inner ball. Infinity where it is wider than anybody wants to know.
  double gap = std::numeric_limits<double>::infinity();
};

struct RefinedSample {
  std::int32_t number = -1;    // samples count from 0; far-away points stay -1
  std::int32_t triangle = -1;  // where it lies
  double floor = 0;            // balls through it that reach less deep need not be refined
};

using RefineKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using RefineDelaunay = CGAL::Delaunay_triangulation_3<
    RefineKernel,
    CGAL::Triangulation_data_structure_3<
        CGAL::Triangulation_vertex_base_with_info_3<RefinedSample, RefineKernel>,
        CGAL::Triangulation_cell_base_with_info_3<RefinedCell, RefineKernel,
                                                  CGAL::Delaunay_triangulation_cell_base_3<RefineKernel>>>>;

class RefinedTriangulation {
 public:
  using Cell = RefineDelaunay::Cell_handle;
  using Vertex = RefineDelaunay::Vertex_handle;

  /// Twelve far-away points are in it, so the cells of every sample are finite. The surface is closed;
  /// gaps beyond `widest` are not looked at. What is handed over must outlive it.
  RefinedTriangulation(const SurfaceTree& surface, const WindingNumber& winding, const Box& box,
                       double widest);

  /// A new sample with the given floor near the cell `hint` (or none); false where there is one already.
  bool insert(const SurfacePoint& at, double floor, Cell hint);

  /// Looks at all cells that are new since the last time, on all cores, and returns them.
  std::vector<Cell> evaluate(Monitor& monitor);

  RefineDelaunay& delaunay() { return delaunay_; }
  const SurfaceTree& surface() const { return surface_; }
  /// The longest edge of the bounding box of the surface.
  double size() const { return size_; }
  std::size_t samples() const { return samples_.size(); }
  /// In the order of insertion.
  const std::vector<Vertex>& vertices() const { return samples_; }

  /// The lowest floor of the samples of a cell.
  static double floor_of(Cell cell);

 private:
  void evaluate(Cell cell) const;

  RefineDelaunay delaunay_;
  const SurfaceTree& surface_;
  const WindingNumber& winding_;
  double size_, widest_;
  std::vector<Vertex> samples_;
  std::size_t evaluated_ = 0;  // samples whose cells have been looked at
  Cell last_;
};

inline Vec3 position(const RefinedTriangulation::Vertex& vertex) {
  return {vertex->point().x(), vertex->point().y(), vertex->point().z()};
}

}  // namespace ballflow::geometry
