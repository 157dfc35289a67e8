// The solid inside a surface on a lattice: what an enclosing union wastes is counted by its points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Points outside of the solid, each for a part of the space there.
struct OutsidePoints {
  std::vector<Vec3> points;
  std::vector<std::int32_t> weights;  // volume that a point stands for, in units: 1, 8, 64 or 512
  double unit = 0;                    // cubed model units
  double spacing = 0;                 // of the lattice, model units
  std::int64_t solid = 0;             // volume inside, in units
  std::vector<Vec3> inside;           // some points of the solid, evenly spread
};

struct SolidLatticeOptions {
  double band = 0.1;            // model units: balls are not expected to stand out farther
  std::int64_t points = 40000;  // about how many of them outside
  std::int64_t inside = 1500;   // about how many of them inside
};

/// A lattice along the axes, which the surface should not be parallel to. Near the surface every point
/// counts, from 22 % of the band on every eighth, from 55 % every 64th, beyond it every 512th, to one and a
/// half bands around the box.
///
/// A point is inside when the surface winds around it, by crossings with the lines through it along the three
/// axes; a line that leaves the surface more often than it enters it (holes) has no say, and the majority of
/// the others decides. Triangles that disagree with their neighbours are turned over first (surface_chain).
/// - Precondition: no broken invariant, at least one triangle, a box that is not empty; band > 0.
OutsidePoints outside_points(const TriangleMesh& mesh, const SolidLatticeOptions& options,
                             Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
