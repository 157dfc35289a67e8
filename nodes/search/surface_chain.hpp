// The triangles of a mesh as an oriented chain: which way each one faces, and what bounds them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A mesh whose triangles face consistent ways as far as that is possible.
///
/// Where the input is consistent it is kept. Otherwise triangles are turned over so that neighbours at edges
/// of exactly two triangles agree; each connected piece then keeps the way most of its triangles faced.
struct SurfaceChain {
  std::vector<Triangle> triangles;      // triangles with a repeated corner are left out
  std::vector<std::int32_t> component;  // per triangle; triangles that share an edge share a component
  std::int32_t components = 0;

  // What remains when every edge is counted +1 in one direction and -1 in the other, repeated by
  // multiplicity: (u, v) is a side of one triangle more than (v, u). Empty for closed, orientable meshes.
  std::vector<std::array<std::int32_t, 2>> boundary;

  std::int64_t turned = 0;             // triangles turned over
  std::int64_t boundary_edges = 0;     // edges of one triangle
  std::int64_t nonmanifold_edges = 0;  // edges of three and more triangles
  std::int64_t contradictions = 0;  // edges of two triangles that still disagree: the mesh is not orientable

  /// The winding number is an integer everywhere off the surface.
  bool closed() const { return boundary.empty() && !triangles.empty(); }
};

/// Precondition: broken_invariant(mesh) is empty.
SurfaceChain surface_chain(const TriangleMesh& mesh);

/// Why the chain of a mesh has no well-defined inside everywhere, in words. Precondition: it is not closed.
std::string why_not_closed(const SurfaceChain& chain, const TriangleMesh& mesh);

}  // namespace ballflow::geometry
