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
  // A closed surface is refused that contradicts more of what the poles say, or whose area is more gaps than
  // that. Of clouds of closed surfaces without sharp edges hardly any contradicts more than .004.
  double most_overruled = 0.05;
  double most_filled = 0.7;
  // Or whose area is more holes than that: gaps that are so many times as large as the balls around them, and
  // as the distance to the third neighbour.
  double most_holes = 0.1;
  double hole = 1.4;
  // Open: holes are not closed but left, but those smaller than `smallest_hole` of the area. Then neither
  // most_filled nor most_holes matters, and most_overruled three times.
  bool open = false;
  double smallest_hole = 1e-3;
  // Any surface is refused that passes more balls by, as share of the squared radii of all, and ten at least.
  double most_left_out = 0.05;
  double smallest_component = 0.01;  // of the area of the largest: smaller components are left out
};

struct SurfaceMesh {
  TriangleMesh
      mesh;  // oriented 2-manifold, closed but where `open`; vertices are centres of balls, but for midpoints
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
/// What speaks against a surface is in the report (surface_evidence.hpp). Warns where more than .5 % of the
/// balls are passed by, as with sheets as thin as the spacing, where holes are closed, and where more than
/// half of the area is gaps.
///
/// Throws InputError where the evidence says that there is no solid (votes on the wrong side, gaps, holes,
/// balls passed by, beyond the options; nothing is inside), for balls in one plane, and for poles and balls
/// of other samples.
SurfaceMesh surface_mesh(const PowerDiagram& diagram, const PoleSet& poles, const PointSet& sample,
                         const SurfaceMeshOptions& options, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
