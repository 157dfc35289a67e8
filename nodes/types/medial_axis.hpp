// The medial axis of a union of balls as a polygon complex (Amenta and Kolluri 2001; thesis, 3.7).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "base/array.hpp"
#include "base/monitor.hpp"
#include "base/vec3.hpp"

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

  // Sheets: the components of the polygons after cutting at seams. Polygons that share an edge of exactly
  // two polygons belong to one sheet; polygons that share but a vertex do not for that.
  Array<std::int32_t> polygon_sheets;  // f: the sheet of each polygon, numbered by their first polygons
  // s: 1 when the polygons of the sheet all face one way, so that two neighbours run through their common
  // edge in opposite directions; 0 when no choice of directions does that: a Moebius band
  Array<std::uint8_t> sheet_orientable;

  // Seams: the edges of three and more polygons, where sheets meet.
  Array<std::array<std::int32_t, 2>> seams;  // m x 2 vertex indices, the smaller one first; ascending
  Array<std::int32_t> seam_degrees;          // m: polygons at the edge
  // m: the curve of each edge, numbered by their first edges. Two seams belong to one curve when they share a
  // vertex at which no other seam ends.
  Array<std::int32_t> seam_curves;

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

/// The axis with its polygons turned so that they are oriented sheet by sheet, and with sheets and seams
/// labelled. The first polygon of a sheet keeps its direction; a sheet that is not orientable is as
/// consistent as a breadth-first search from its first polygon makes it. Polygons, vertices and free edges
/// must hold their invariants; what the labels were does not matter.
MedialAxis with_sheets(MedialAxis axis, Monitor& monitor = no_monitor());

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const MedialAxis& axis);

}  // namespace ballflow::geometry
