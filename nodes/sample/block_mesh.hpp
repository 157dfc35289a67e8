// Surfaces of solids made of axis-parallel blocks.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A solid that is constant between successive planes of each axis.
struct Blocks {
  std::array<std::vector<double>, 3> planes;  // ascending positions per axis, at least two
  std::function<bool(int, int, int)> solid;   // of the cell between planes i, j, k and the next ones
};

/// The surface of the solid on a grid of spacing h or a little less that contains all planes. Outward
/// oriented, closed; manifold when the solid has no two cells that touch in an edge or corner only.
TriangleMesh block_mesh(const Blocks& blocks, double h);

/// Area of that surface.
double block_area(const Blocks& blocks);

}  // namespace ballflow::geometry
