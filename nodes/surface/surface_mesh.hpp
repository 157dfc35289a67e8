// A closed surface through the kept samples of a cloud of points (thesis, 4.5.3).
#pragma once

#include "base/monitor.hpp"
#include "types/point_set.hpp"
#include "types/pole_set.hpp"
#include "types/power_diagram.hpp"
#include "types/surface_report.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct SurfaceMeshOptions {
  // A surface is refused that contradicts more of what the poles say, or whose area is more holes than that.
  // Of clouds of closed surfaces without sharp edges hardly any contradicts more than .004.
  double most_overruled = 0.05;
  double most_filled = 0.5;
  double smallest_component = 0.01;  // of the area of the largest: smaller components are left out
};

struct SurfaceMesh {
  TriangleMesh
      mesh;  // closed, oriented 2-manifold; vertices are centres of balls, unmoved, but for midpoints
  SurfaceReport report;
};

/// The zero alpha-shape of surface balls (the triangles of their dual complex, as the thesis takes it) has
/// holes and edges of many triangles on real clouds. Here the cells of the regular triangulation are told
/// inside from outside by the poles (cell_labels.hpp), and the surface is what lies between
/// (cell_boundary.hpp): closed whatever holes the complex has.
///
/// - `diagram`: of the kept surface balls
/// - `poles`, labelled, with their `uncertain` flags: of `sample`, all samples
/// - does not depend on the number of threads, nor on the order of samples but by the order of vertices
///
/// Throws InputError where the evidence says that there is no solid (more than `most_overruled` of the poles
/// are on the wrong side, more than `most_filled` of the area closes holes, nothing is inside), for balls in
/// one plane, and for poles of other samples.
SurfaceMesh surface_mesh(const PowerDiagram& diagram, const PoleSet& poles, const PointSet& sample,
                         const SurfaceMeshOptions& options, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
