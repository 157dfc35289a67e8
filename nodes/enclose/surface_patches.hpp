// A surface cut into small triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Triangles that together are those of a mesh. A ball that holds the corners of a patch holds the patch.
struct SurfacePatches {
  std::vector<Vec3> vertices;                        // no two with equal coordinates
  std::vector<std::array<std::int32_t, 3>> corners;  // m x 3
};

/// Triangles are bisected at their longest edges until none is longer than `longest` (or than a double can
/// tell). Equal patches, of triangles that a mesh holds twice, are kept once. Degenerate triangles are
/// patches like others: their points are covered too. Vertices lie at (repeated) midpoints, rounded.
/// - Order: along a space-filling curve, so that neighbours in the lists are neighbours in space.
/// - Precondition: the mesh has no broken invariant, longest > 0.
SurfacePatches surface_patches(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                               double longest);

/// Cuts only the patches that `cut` names (m flags), and only once each, at the longest edge; edges that are
/// not longer than `shortest` stay.
SurfacePatches refined(const SurfacePatches& patches, const std::vector<std::uint8_t>& cut, double shortest);

/// The sum of the areas of the triangles.
double surface_area(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

}  // namespace ballflow::geometry
