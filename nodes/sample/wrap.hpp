// A closed surface around an open one.
#pragma once

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct WrapOptions {
  // % of the longest edge of the bounding box.
  double alpha = 2;     // holes narrower than this are closed, wider ones are entered
  double offset = 0.2;  // how far outside of the surface the result lies
};

/// The alpha wrap of any triangles (Portaneri, Rouxel-Labbe, Hemmer, Cohen-Steiner and Alliez 2022; CGAL):
/// closed, oriented, manifold and free of self-intersections, and everywhere about the offset away from the
/// triangles. An open sheet becomes a shell around it, as thick as twice the offset, where no hole is
/// narrower than alpha.
///
/// Refuses (InputError) a mesh without triangles or with damaged invariants, and options out of range. With
/// small alpha and offset it takes minutes.
TriangleMesh wrap(const TriangleMesh& mesh, const WrapOptions& options, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
