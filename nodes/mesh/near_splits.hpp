// The triangles of a grid's mesh among which some may cross.
#pragma once

#include <cstdint>

#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// The triangles with a vertex from `first_split` on, and those whose boxes meet cells of edge `cell`, model
/// units, that the former meet; all vertices. Where triangles without such a vertex do not cross each other,
/// every pair that crosses is among them. Precondition: the mesh has a triangle, and its box not much more
/// than 2^25 cells, a byte each.
TriangleMesh near_splits(const TriangleMesh& mesh, std::int32_t first_split, double cell);

}  // namespace ballflow::geometry
