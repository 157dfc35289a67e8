// The surface of what has a label in a grid.
#pragma once

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"
#include "volume/volume.hpp"

namespace ballflow::geometry {

struct LabelSurfaceOptions {
  std::int32_t label = 0;  // the surface of the voxels with this label; 0: of all that are not 0
};

/// The mesh that separates the centers of voxels inside from those outside: every cube of eight centers is
/// split in six tetrahedra around its diagonal (Kuhn), in the same way everywhere, and vertices lie halfway
/// on the edges from inside to outside. It is a closed, outward oriented manifold whatever voxels these are;
/// around the image everything is outside. Coordinates are those of the file. Planes of voxels become planes
/// halfway between centers; a single voxel, and parts one voxel thin, lose up to half of their volume;
/// nothing is smoothed.
///
/// Throws InputError for a label that no voxel has (naming labels there are), and beyond 2^31 - 1 vertices or
/// triangles.
TriangleMesh label_surface(const LabelVolume& volume, const LabelSurfaceOptions& options = {},
                           Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
