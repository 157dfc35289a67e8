// The parts of a mesh that do not hang together, one by one.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct SplitComponentsOptions {
  std::int64_t component =
      0;  // which one, from 0 on: by area, the largest first, of equal ones that with the first triangle
};

struct MeshComponent {
  TriangleMesh mesh;            // triangles and vertices in the order of the whole, no others
  std::int64_t components = 0;  // of the whole
};

/// One connected component of the triangles of any mesh; triangles hang together by common vertices, so equal
/// ones must be welded (as Sample does). Throws InputError for a mesh without triangles and for a component
/// that there is not.
MeshComponent split_components(const TriangleMesh& mesh, const SplitComponentsOptions& options,
                               Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
