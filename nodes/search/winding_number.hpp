// Winding numbers of points about a triangle mesh, closed or not.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "search/signed_crossings.hpp"
#include "search/solid_angles.hpp"
#include "search/surface_chain.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// How often a mesh winds around a point: an integer for closed meshes, the generalized winding number
/// [Jacobson et al. 2013] for others, a fraction that tends to 1 inside and to 0 outside as the holes shrink.
///
/// Every closed piece of the boundary is joined to its mean point by triangles. Mesh and these caps together
/// are a closed chain, whose winding number is an integer that exact predicates count along a ray; what the
/// caps contribute is a sum of solid angles, subtracted in floating point. Closed meshes have no
/// error. The sum over caps is hierarchical: numbers of open meshes are off by up to 1/5, but as much more
/// accurate as it takes to tell on which side of 1/4, 1/2 and 3/4 they are.
///
/// Orientation is repaired as in SurfaceChain. Of a closed mesh every component is then turned outwards,
/// except those that bound a cavity: components of negative volume inside components of positive volume.
class WindingNumber {
 public:
  /// Precondition: broken_invariant(mesh) is empty.
  WindingNumber(const TriangleMesh& mesh, Monitor& monitor);

  struct Value {
    double number = 0;
    bool on_surface = false;  // the point lies exactly on a triangle: the number is that of one of the sides
  };
  Value around(Vec3 point) const;

  const SurfaceChain& chain() const { return chain_; }
  /// Of a closed mesh: the integral of its winding number, in cubed model units. What it winds around twice
  /// counts twice, a cavity not at all. 0 for open meshes.
  double enclosed_volume() const { return enclosed_volume_; }
  /// Triangles turned over, by the repair of the chain and by turning components outwards.
  std::int64_t turned() const { return turned_; }

 private:
  void turn_outwards(const TriangleMesh& mesh);
  SurfaceChain chain_;
  std::vector<std::int8_t> sign_;  // per triangle of the chain, -1 where its component is turned over
  std::int64_t turned_ = 0;
  double enclosed_volume_ = 0;
  SignedCrossings crossings_;  // triangles of the chain, then the caps
  SolidAngles caps_;
};

}  // namespace ballflow::geometry
