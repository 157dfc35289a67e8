// The thinnest wall of a solid and the narrowest slot in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// How far it is from a triangle, along its normal, to the next one, which faces the other way.
struct Width {
  double width = 0;
  Vec3 from, to;  // the middle of the triangle, and what is opposite
  std::int32_t triangle = -1, opposite = -1;
};

struct Widths {
  std::optional<Width> wall;  // the thinnest: through the solid
  std::optional<Width> slot;  // the narrowest: through the outside, or through a cavity
  std::int64_t places = 0;    // triangles that were measured
  // How many of these are nearer to what is opposite than the length of their longest edge.
  std::int64_t thin_walls = 0, narrow_slots = 0;
  std::vector<double>
      walls;  // per triangle, when they are asked for: the wall behind it, infinite where there is none
};

struct WidthsOptions {
  /// Beyond so many triangles only some are measured, evenly by their number.
  std::int64_t places = 500000;
  /// Two triangles face opposite ways when the angle between them is at most this. At a larger one they are
  /// the flanks of an edge, of which no wall and no slot has any width.
  double largest_angle = 30;  // degrees
  /// Lists the wall behind every triangle; without that a search ends where it can change nothing, which
  /// takes a tenth of the time.
  bool list_walls = false;
};

/// Measures from the middle of triangles. Triangles face outwards, those of cavities into these. What shares
/// a vertex with a triangle is not opposite to it; what is nearer than 1e-9 of the bounding box is touched.
/// Precondition: broken_invariant(mesh) is empty.
Widths widths_of(const TriangleMesh& mesh, const WidthsOptions& options = {},
                 Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
