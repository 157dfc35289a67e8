// How a surface was found among the cells of a triangulation, and what speaks for it.
#pragma once

#include <cstdint>
#include <string>

#include "base/array.hpp"

namespace ballflow::geometry {

struct SurfaceReport {
  std::int64_t components = 0;
  std::int64_t genus = 0;            // of all components together
  double overruled = 0;              // share of the weight of the poles' votes that the surface contradicts
  double filled_area = 0;            // share of the area where no ball's union is: holes that were closed
  std::int64_t mixed_voids = 0;      // parts of space with votes for both sides, which were cut
  std::int64_t split_vertices = 0;   // copies of vertices where sheets touch
  std::int64_t midpoints = 0;        // vertices that are no samples
  std::int64_t specks = 0;           // small components that were left out
  Array<std::int32_t> vertex_balls;  // per vertex of the mesh: the ball whose centre it is, -1 for midpoints
  Array<std::uint8_t> filled;        // per triangle: 1 where it closes a hole
};

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const SurfaceReport& report);

}  // namespace ballflow::geometry
