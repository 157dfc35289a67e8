// A Delaunay triangulation as a plain table, in an order that depends on the numbering of the points only.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

struct DelaunayCell {
  static constexpr std::int32_t infinite = std::numeric_limits<std::int32_t>::max();

  std::array<std::int32_t, 4> corners;  // indices of points, ascending; an infinite cell ends with `infinite`
  std::array<std::int32_t, 4> neighbors;  // indices of cells; neighbors[k] lies opposite corners[k]
  bool finite() const { return corners[3] != infinite; }
};

/// The cells of the triangulation of pairwise distinct points (n x 3), in lexicographic order of their
/// corners. Empty when the points lie in a plane. Cospherical points are triangulated by a symbolic
/// perturbation.
std::vector<DelaunayCell> delaunay_cells(std::span<const Vec3> points, Monitor& monitor);

}  // namespace ballflow::geometry
