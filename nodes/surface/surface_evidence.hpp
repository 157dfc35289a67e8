// What speaks against a surface that was found among the cells of a triangulation.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "surface/cell_boundary.hpp"
#include "surface/cell_labels.hpp"
#include "types/power_diagram.hpp"

namespace ballflow::geometry {

struct SurfaceEvidence {
  // Per triangle: 0 in the dual complex, 1 where it closes a gap, 2 where it closes a wide one: the sphere in
  // the gap that is orthogonal to the three balls is `hole` times as large as they are, and as the spacing
  // is.
  std::vector<std::uint8_t> filled;
  std::vector<std::uint8_t>
      overruled;  // per triangle: 1 where votes say that a cell beside it is on the other side
  double filled_area = 0, wide_area = 0;  // shares of the area
  // Balls whose centre is farther from the surface than their radius: it passes them by. Their number, their
  // share of the squared radii of all, and how far the farthest is, in model units.
  std::int64_t left_out = 0;
  double left_out_area = 0, farthest = 0;
  // The most of them that hang together, by balls that meet, and the centre of the one of these that is
  // farthest from the surface. Samples that noise moved lie here and there; a part of the shape is a patch.
  std::int64_t left_out_patch = 0;
  Vec3 patch_at = {};
};

/// `spacing`: of the samples around each ball's centre, model units.
SurfaceEvidence surface_evidence(const PowerDiagram& diagram, const CellLabels& labels,
                                 const CellBoundary& surface, const std::vector<double>& spacing, double hole,
                                 Monitor& monitor = no_monitor());

/// The radius of the sphere that is orthogonal to the balls of a facet: how wide the gap between them is. 0
/// where they have a point in common, infinite where their centres are on a line.
double facet_gap(const PowerDiagram& diagram, const CellFacet& facet);

/// The surface without the patches that close wide gaps (2 in `filled`) and the smaller gaps (1) next to
/// them, and without components that are then smaller than `smallest_component` of the largest: oriented, its
/// edges in one or two triangles, its vertices in one fan each. Patches smaller than `smallest_hole` of the
/// area stay.
CellBoundary without_holes(const CellBoundary& surface, const std::vector<std::uint8_t>& filled,
                           double smallest_hole, double smallest_component);

}  // namespace ballflow::geometry
