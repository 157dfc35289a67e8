// What the balls have to cover: the samples alone, or more of the surface between them.
#pragma once

#include <cstdint>

#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class Demand : std::uint8_t {
  samples,
  facets,   // and the centre of every triangle
  edges,    // and of every triangle and edge
  patches,  // whole triangles: one ball has to contain all three corners
};

struct CoverPoints {
  PointSet points;  // the samples first, then centres; pairwise distinct, without normals if there are any
  TriangleMesh patches;  // of Demand::patches: vertices are the points; without triangles else
};

/// Where walls are thin a ball reaches few samples, and balls that cover all samples leave holes between
/// them. Centres of triangles cost nothing to have and close most holes before a repair has to; thick shapes
/// are covered by fewer balls without.
///
/// - `surface` is a triangulation of the samples: its vertices are they. Without triangles there is nothing
///   between samples, and every demand is that for samples.
/// - A union that covers patches contains the triangles whole.
///
/// Throws InputError where the surface's vertices are not the samples, or an index is out of range.
CoverPoints cover_points(const PointSet& samples, const TriangleMesh& surface, Demand demand);

}  // namespace ballflow::geometry
