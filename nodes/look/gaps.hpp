// Where a mesh is open, and what welding would close.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/monitor.hpp"
#include "io/weld.hpp"
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
  std::int64_t open_edges = 0;     // of one triangle
  std::vector<Rim> rims;           // the longest first
  std::optional<SmallGaps> small;  // what welding closes, where it closes at least half
};

/// Precondition: broken_invariant(mesh) is empty and no triangle repeats a vertex.
Gaps gaps_of(const TriangleMesh& mesh, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
