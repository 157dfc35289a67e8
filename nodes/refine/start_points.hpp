// The few points of a surface from which its refinement starts.
#pragma once

#include <vector>

#include "search/surface_tree.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct StartPointsOptions {
  double sharp = 30;         // degrees: edges whose triangles turn by more are sharp, corners where they do
  double spacing = 0.02;     // along sharp edges, in longest edges of the bounding box
  std::size_t spread = 200;  // points all over the surface
  double thinning = 0.005;   // of corners: one for each cube of this edge, in the same unit; 0 keeps all
};

/// Corners of sharp edges (ends, branchings, turns), thinned: on noisy scans they are many. Points along
/// sharp edges, six extreme vertices of every connected piece, and `spread` centroids of triangles, evenly by
/// area. Edges with one, three and more triangles are sharp too. Pairwise distinct. Precondition:
/// broken_invariant(mesh) is empty.
std::vector<SurfacePoint> start_points(const TriangleMesh& mesh, const StartPointsOptions& options);

}  // namespace ballflow::geometry
