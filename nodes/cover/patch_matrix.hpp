// The covering matrix of balls and triangles: c_ij = 1 iff ball i contains triangle j whole.
#pragma once

#include "base/monitor.hpp"
#include "cover/cover_matrix.hpp"
#include "search/membership.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A ball is convex: it contains a triangle iff it contains the corners. By membership.hpp and nothing else:
/// samples that define a ball are no exception here.
inline bool contains_patch(Vec3 center, double squared_reach_of_ball, const TriangleMesh& mesh,
                           const Triangle& patch) {
  return in_reach(center, squared_reach_of_ball, mesh.vertices[static_cast<std::size_t>(patch[0])]) &&
         in_reach(center, squared_reach_of_ball, mesh.vertices[static_cast<std::size_t>(patch[1])]) &&
         in_reach(center, squared_reach_of_ball, mesh.vertices[static_cast<std::size_t>(patch[2])]);
}

/// As cover_matrix(), with the triangles of `patches` in place of samples: a union of balls that covers them
/// contains them whole. Every "sample" of the result is a triangle.
///
/// Refused with InputError: what cover_matrix refuses, indices out of range, UncoveredPolicy::ball (no ball
/// of radius 0 contains a triangle).
CoverMatrix patch_matrix(const Balls& balls, const TriangleMesh& patches,
                         const CoverMatrixOptions& options = {}, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
