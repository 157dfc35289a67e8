// The boundary of a union of balls as triangles in tetrahedra on the cells of a grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct GridMesh {
  TriangleMesh mesh;
  std::int32_t first_split = 0;  // the vertices from here on split triangles; those of others do not cross
  double error =
      0;  // the largest distance from the boundary that was found, in the middle of triangles and edges
};

/// Every cell of a grid with edges of length `cell` is split in six tetrahedra around its diagonal (Kuhn), in
/// the same way, so that neighbours agree; the mesh separates the corners in the union from those that are
/// not. It is a closed, oriented manifold whatever corners these are. On an edge of a tetrahedron the vertex
/// is where the way from the inner corner leaves the union of the balls near by. Thin parts and balls between
/// corners are missed. Triangles between different spheres are split where these meet (creases.hpp): only
/// there may triangles cross. Nothing when there would be more than `most_corners`, or more than
/// `most_faces`. The same bytes for any number of threads. There is a ball, and one has a radius above 0.
std::optional<GridMesh> grid_mesh(const Balls& balls, double cell, std::size_t most_corners,
                                  std::size_t most_faces, Monitor& monitor);

}  // namespace ballflow::geometry
