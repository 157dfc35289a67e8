// Samples of a mesh that do not depend on how it is triangulated.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class Spread {
  random,   // independent points, uniform by area: clumps and gaps
  poisson,  // evenly spaced: 5 times as many random points, thinned out by sample elimination (Yuksel 2015)
};

struct SurfaceSampleOptions {
  Spread spread = Spread::poisson;
  std::int64_t count = 10000;  // points, 4 to 2 million
  std::uint64_t seed = 0;
};

/// Points on the triangles of a mesh, pairwise distinct, with the normals of their triangles.
///
/// - the mesh needs a triangle of positive area; it may be open, non-manifold and self-intersecting
/// - fewer points than asked for come back only where doubles cannot tell so many apart
///
/// Throws InputError for a mesh without area and a count out of range.
PointSet sample_surface(const TriangleMesh& mesh, const SurfaceSampleOptions& options,
                        Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
