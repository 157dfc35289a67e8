// A triangle mesh as an indexed face set. Any set of triangles is a TriangleMesh: open, non-manifold and
// unoriented ones too; MeshTopology says what a given one is.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/monitor.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

using Triangle = std::array<std::int32_t, 3>;

struct TriangleMesh {
  Array<Vec3> vertices;       // n x 3, model units; finite
  Array<Triangle> triangles;  // m x 3 vertex indices, counter-clockwise seen from outside where oriented
};

struct MeshTopology {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
  bool closed = false;    // every edge belongs to exactly two triangles (false for no triangles)
  bool manifold = false;  // every edge has at most two triangles, every vertex star is one disk or half disk
  bool oriented = false;  // no two triangles run through a shared edge in the same direction
  std::int64_t genus =
      -1;  // total over the components, boundary loops filled; -1 when not manifold or not oriented
  std::int64_t components = 0;      // connected components of the triangles (by shared vertices)
  std::int64_t boundary_loops = 0;  // closed chains of edges with one triangle
  std::int64_t boundary_edges = 0;
  std::int64_t nonmanifold_edges = 0;  // edges with more than two triangles
};

MeshTopology mesh_topology(const TriangleMesh& mesh, Monitor& monitor = no_monitor());

/// Empty when every index is in range and every coordinate finite, else what is wrong and where.
std::string broken_invariant(const TriangleMesh& mesh);

}  // namespace ballflow::geometry
