// From the faces that a file lists to the triangles of a mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "io/raw_model.hpp"

namespace ballflow::geometry {

struct FaceCounts {
  std::int64_t degenerate = 0;  // triangles with a repeated vertex
  std::int64_t concave = 0;     // polygons that no fan fills, triangulated inside themselves
  std::int64_t bent = 0;        // of these, not flat
  std::int64_t crossing = 0;    // polygons that cross themselves or have no area: fans all the same
  std::int64_t repeated = 0;    // triangles with the vertices of one that stays
  std::int64_t cancelled = 0;   // triangles with the same vertices, of which none stays
};

/// The triangles of the model, its polygons triangulated (see triangulate_polygon), with `first[v]` for
/// vertex v, and none with a repeated vertex. Polygons with the same corners, from whichever on and
/// whichever way round, get the same triangles.
std::vector<Triangle> triangles_of(const RawModel& model, std::span<const std::int32_t> first,
                                   FaceCounts& counts, Monitor& monitor);

/// Leaves one of every set of triangles with the same vertices, the first one, or none: an even number of
/// them cancel where they close nothing. Sets that are connected by edges without other triangles are one
/// sheet. It goes when more of its rim lies on edges with two, four, ... other triangles, where it is a wall
/// in a solid or a flap on it, than on edges with one, where it closes a hole. A sheet that hangs on nothing
/// stays.
void drop_repeated(std::vector<Triangle>& triangles, std::size_t vertices, FaceCounts& counts);

}  // namespace ballflow::geometry
