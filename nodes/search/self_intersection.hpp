// Whether a triangle mesh intersects itself, decided exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Two triangles that have a point in common which is not their common vertex or edge, or one triangle
/// without area, named twice. Nothing when the mesh is embedded.
/// Precondition: broken_invariant(mesh) is empty and no triangle repeats a vertex.
std::optional<std::array<std::int32_t, 2>> self_intersection(const TriangleMesh& mesh, Monitor& monitor);

/// All of them.
struct SelfIntersections {
  std::vector<std::int32_t> flat;                  // triangles without area, ascending
  std::vector<std::array<std::int32_t, 2>> pairs;  // of the others, ascending, the smaller number first
  bool all = true;                                 // false: there are more pairs than were asked for
};

/// Ends when it has found `most` pairs. Precondition as above.
SelfIntersections self_intersections(const TriangleMesh& mesh, std::size_t most, Monitor& monitor);

}  // namespace ballflow::geometry
