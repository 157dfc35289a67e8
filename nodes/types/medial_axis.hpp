// The medial axis of a union of balls as a polygon complex (Amenta and Kolluri 2001; thesis, 3.7).
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "types/array.hpp"
#include "types/vec3.hpp"

namespace ballflow::geometry {

/// What a polygon or edge of the axis is.
enum class AxisKind : std::uint8_t {
  singular = 0,  // a simplex of the alpha-shape that belongs to no tetrahedron
  voronoi = 1,   // a piece of a Voronoi facet of the union's vertices, inside the regular part
  wall = 2,      // joins the axis inside a solid wedge to the edge of the alpha-shape it hangs on
};

struct MedialAxis {
  Array<Vec3> vertices;  // v x 3, model units; every one is used by an edge or polygon, or is isolated
  Array<double> radii;   // v: radius of the maximal inscribed ball of the union at the vertex

  Array<std::array<std::int32_t, 2>> edges;  // e x 2 vertex indices: edges that bound no polygon
  Array<std::int64_t> polygon_offsets;       // f + 1
  Array<std::int32_t> polygon_vertices;  // corners of polygon i: [polygon_offsets[i], polygon_offsets[i + 1])
  Array<std::uint8_t> polygon_kinds;     // f, AxisKind

  std::size_t polygons() const { return polygon_kinds.size(); }
  std::span<const std::int32_t> polygon(std::size_t i) const {
    const auto first = static_cast<std::size_t>(polygon_offsets[i]);
    return polygon_vertices.span().subspan(first, static_cast<std::size_t>(polygon_offsets[i + 1]) - first);
  }
};

struct AxisTopology {
  std::int64_t euler_characteristic = 0;  // V - E + F with every edge of every polygon counted once
  std::int64_t components = 0;
};
AxisTopology axis_topology(const MedialAxis& axis);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const MedialAxis& axis);

}  // namespace ballflow::geometry
