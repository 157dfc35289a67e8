// How a surface was found among the cells of a triangulation, and what speaks for it and against it.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

struct SurfaceReport {
  std::int64_t components = 0;
  std::int64_t genus = 0;            // of all components together, boundary loops filled
  std::int64_t boundary_loops = 0;   // 0 for a closed surface
  double overruled = 0;              // share of the weight of the poles' votes that the surface contradicts
  double filled_area = 0;            // share of the area where no ball's union is: gaps that were closed
  double wide_area = 0;              // of it where the gap is wider than the balls around it: holes
  std::int64_t left_out = 0;         // balls that the surface passes by, farther than their radius
  double left_out_area = 0;          // their share of the squared radii of all
  double farthest = 0;               // how far the farthest of them is, model units
  std::int64_t left_out_patch = 0;   // the most of them that hang together, by balls that meet
  Vec3 patch_at = {};                // the one of these that is farthest from the surface
  std::int64_t mixed_voids = 0;      // parts of space with votes for both sides, which were cut
  std::int64_t split_vertices = 0;   // copies of vertices where sheets touch
  std::int64_t midpoints = 0;        // vertices that are no samples
  std::int64_t specks = 0;           // small components that were left out
  Array<std::int32_t> vertex_balls;  // n, per vertex: the ball whose centre it is, -1 for midpoints
  Array<std::uint8_t> filled;        // m, per triangle: 1 where it closes a gap, 2 where a wide one
  Array<std::uint8_t> contradicted;  // m: 1 where votes say that what is beside it is on the other side
  // The surface itself, so that the report can be shown; where samples were denoised, through the moved ones.
  Array<Vec3> vertices;                          // n x 3
  Array<std::array<std::int32_t, 3>> triangles;  // m x 3
};

/// What can be said of a triangle: 0 nothing, 1 it closes a gap, 2 a wide one, 3 it is contradicted.
inline std::uint8_t evidence(const SurfaceReport& report, std::size_t triangle) {
  return report.contradicted[triangle] == 1 ? std::uint8_t{3} : report.filled[triangle];
}

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const SurfaceReport& report);

}  // namespace ballflow::geometry
