// Fewer triangles for a closed surface, by collapsing edges.
#pragma once

#include <cstddef>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Edges are collapsed one after the other, the one that changes shape and volume least first (Lindstrom and
/// Turk 1998, by CGAL), until at most `faces` triangles are left or no edge can be collapsed without changing
/// the topology. A closed manifold stays one, of the same genus and number of components; that triangles do
/// not cross is not promised. The same bytes for any number of threads. Precondition: the mesh is a closed,
/// oriented manifold.
TriangleMesh simplified_mesh(const TriangleMesh& mesh, std::size_t faces, Monitor& monitor);

}  // namespace ballflow::geometry
