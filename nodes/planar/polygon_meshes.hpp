// Triangles of polygons, for what is proven of meshes in space.
#pragma once

#include "base/monitor.hpp"
#include "types/polygon2.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct PolygonMeshes {
  TriangleMesh flat;   // in the plane z = 0: the vertices of the polygon, and triangles that tile its inside
  TriangleMesh prism;  // closed: the polygon from z = -2 L to 2 L, L the longest edge of its bounding box
};

/// A ball with its centre in the plane z = 0 meets the plane in a disc of its own radius. So discs contain
/// the polygon where balls contain `flat`, exactly; balls around centres in the plane never close off a part
/// of space. And the distance of such a centre to `prism` is that to the boundary of the polygon, as long as
/// it is below 2 L; whether it is inside is the same question, too.
/// - The triangulation is the constrained Delaunay one: no vertices but those of the polygon.
/// - Throws InputError for damaged polygons, those without components, and rings that cross or touch.
PolygonMeshes polygon_meshes(const Polygon2& polygon, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
