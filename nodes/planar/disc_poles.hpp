// The discs of a polygon: the discrete medial axis transform in the plane (thesis, 5.4).
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/point_set.hpp"
#include "types/polygon2.hpp"

namespace ballflow::geometry {

/// Which Voronoi vertices become discs.
enum class DiscVertices : std::uint8_t {
  all,    // every one: the union of the inner discs contains the polygon
  poles,  // the farthest on either side of each sample
};

struct DiscPolesOptions {
  double spacing = 1;  // of samples on the edges at most, in % of the longest edge of the bounding box
  DiscVertices vertices = DiscVertices::all;
};

/// Discs are balls whose centers have z = 0.
struct DiscPoles {
  PointSet points;  // the samples in the plane z = 0, along the rings: corners and what lies between them
  Balls inner;      // discs around Voronoi vertices inside, by their defining samples
  Balls outer;      // the same outside, those of Voronoi vertices of bounded cells' triangles only
  std::int64_t splits = 0;  // samples more than the spacing asked for
};

/// Edges are cut into equal pieces no longer than the spacing, then pieces are halved until no sample is
/// strictly inside the circle over a piece. So every piece is an edge of the Delaunay triangulation, every
/// triangle is inside or outside, and the center of an inner triangle's circle is inside (Ruppert 1995): the
/// polygon itself says on which side a pole is. At corners sharper than a right angle pieces are cut at
/// distances that are powers of two times each other, so that this ends.
///
/// - Vertices::all: the union of the inner discs contains the polygon through the samples, which is the
/// polygon
///   up to the rounding of points on edges, and reaches beyond a piece by at most half its length.
/// - Cocircular samples make one disc. Which triangles are Delaunay is decided exactly; the result depends on
///   the polygon alone. Centers are within some 1e-12 radii of the Voronoi vertices, radii the largest
///   distance to their samples.
///
/// Throws InputError for a polygon without components or one that breaks its invariants, sizes outside
/// [1e-90, 1e90], options out of range, edges so near to each other that samples would be closer than
/// coordinates can tell, and more samples than 2^30.
DiscPoles disc_poles(const Polygon2& polygon, const DiscPolesOptions& options = {},
                     Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
