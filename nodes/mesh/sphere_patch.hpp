// The part of one sphere that lies on the boundary of a union of balls, as triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "mesh/arc_net.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct SpherePatch {
  enum class State : std::uint8_t {
    made,
    crossing,    // chords of the patch cross: `cut` names them
    degenerate,  // two points of the net project to one, or a point into the wrong part: nothing helps
  };
  State state = State::degenerate;
  std::vector<std::pair<std::int32_t, std::int32_t>> cut;  // (arc, knot) of chords that must be bisected
  std::vector<Vec3> inside;                                // points of the patch that are not in the net
  std::vector<Triangle> triangles;  // outwards; a point of the net, or -1 - i for the point i inside
  double error = 0;                 // no point of the triangles is farther from the sphere, model units
};

/// The patch on the sphere of `ball`: the constrained Delaunay triangulation, on the sphere, of the chords of
/// its arcs, with points inside until no triangle is farther than `error` from the sphere.
///
/// It is a planar one. Projected from a point of the sphere inside another ball, circles become circles, and
/// Delaunay triangulations of the sphere those of the plane. Points are inserted as well wherever an edge or
/// a triangle inside has all its corners on one other sphere, so that no two patches can have it both.
///
/// `pole` is the direction of the point of projection: the middle of the largest cap inside another ball.
/// Where more than `most` points would have to be inserted, the patch is degenerate.
SpherePatch sphere_patch(const ArcNet& net, std::int32_t ball, Vec3 center, double radius, Vec3 pole,
                         double error, std::size_t most, Monitor& monitor);

/// A whole sphere: the faces of an octahedron, each split in n x n triangles.
SpherePatch whole_sphere(Vec3 center, double radius, double error);

}  // namespace ballflow::geometry
