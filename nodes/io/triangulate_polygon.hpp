// One polygon in space as triangles between its corners.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// How a polygon became triangles.
enum class PolygonShape {
  fan,       // all around its first corner
  filled,    // as below; all its corners are convex, and the fan would have had triangles without area
  concave,   // as below
  crossing,  // the fan all the same: seen along every axis it crosses or touches itself, or has no area
};

struct PolygonTriangulation {
  PolygonShape shape = PolygonShape::fan;
  bool flat = true;  // concave ones: no corner is farther from their mean plane than 2^-10 of their extent
};

/// Appends triangles to `out` whose boundary is the polygon, in its direction, and that lie inside it.
///
/// The polygon is looked at along the coordinate axis nearest to its normal: leaving out a coordinate is
/// exact, and maps a plane that does not contain the axis one to one. Where all triangles around the first
/// corner turn the same way, they are taken. Otherwise the constrained Delaunay triangulation of what is seen
/// is, when the polygon winds around each of its points at most once there: so also around an island with
/// bridges to it. If it crosses itself as seen along that axis, which a bent polygon may, the other axes are
/// tried. Exact predicates decide; no new points.
///
/// - corners: at least 3 indices into `vertices`, no two successive ones equal (the last and the first are
///   successive); equal positions have equal indices. Repeated corners are allowed.
/// - Time O(k log k) for k corners in general; the result depends on nothing but positions and corners.
PolygonTriangulation triangulate_polygon(std::span<const Vec3> vertices,
                                         std::span<const std::int32_t> corners, std::vector<Triangle>& out,
                                         Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
