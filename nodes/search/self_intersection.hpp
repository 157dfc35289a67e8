// Whether a triangle mesh intersects itself, decided exactly.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Two triangles that have a point in common which is not their common vertex or edge, or one triangle
/// without area, named twice. Nothing when the mesh is embedded.
/// Precondition: broken_invariant(mesh) is empty and no triangle repeats a vertex.
std::optional<std::array<std::int32_t, 2>> self_intersection(const TriangleMesh& mesh, Monitor& monitor);

}  // namespace ballflow::geometry
