// Where a mesh is open, and the tolerance with which welding its vertices would close it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Open edges that are connected by vertices: a hole, a crack, or the rim of a sheet.
struct Rim {
  std::int64_t edges = 0;
  double length = 0;  // of its edges together
  Vec3 middle;        // of its bounding box
  double size = 0;    // longest edge of that box
};

/// The edges of one triangle, ascending, the smaller vertex first.
std::vector<std::array<std::int32_t, 2>> open_edges(const TriangleMesh& mesh);

struct Gaps {
  std::int64_t open_edges = 0;  // of one triangle
  std::vector<Rim> rims;        // the longest first
  /// Welding vertices of open edges that are at most so far from each other closes all of these but `left`;
  /// no smaller distance closes as many, and none up to a quarter of the median edge of the mesh closes more.
  /// 0 when none closes any.
  double weld = 0;
  std::int64_t left = 0;
  std::int64_t vanish = 0;  // triangles of which two corners become one by it
};

/// Precondition: broken_invariant(mesh) is empty and no triangle repeats a vertex.
Gaps gaps_of(const TriangleMesh& mesh, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
