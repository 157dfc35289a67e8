// How far points are from medial axes of unions of balls: from every polygon, edge and isolated vertex.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "search/box_tree.hpp"
#include "types/medial_axis.hpp"

namespace ballflow::geometry {

/// The distance to the union of some medial axes. With the axes of the inner and of the outer polar balls it
/// is the discrete local feature size (thesis, Definition 4.1).
///
/// Nothing is sampled: the nearest point of the nearest polygon is computed. Coordinates are rounded, and the
/// point is one of the polygon even where that has no area to speak of, so that distances are too large by
/// rounding only and never too small. Like every distance to a set it changes at most as much as the point
/// does.
class AxisDistance {
 public:
  /// Throws InputError when the axes have no vertex together. Polygons are plane, and one of their corners
  /// sees all of the polygon, as in all convex ones. Precondition: broken_invariant() of every axis is empty.
  explicit AxisDistance(std::span<const MedialAxis> axes, Monitor& monitor = no_monitor());

  /// A function of the axes as sets of points: their order and numbering do not matter but for rounding.
  double operator()(Vec3 p) const;

 private:
  void add(const MedialAxis& axis);
  void add_polygon(const MedialAxis& axis, std::span<const std::int32_t> corners);

  std::vector<std::array<Vec3, 3>> simplices_;  // an edge has one end twice, a vertex is there three times
  BoxTree tree_;
};

/// Of every point.
std::vector<double> axis_distances(std::span<const Vec3> points, const AxisDistance& axis,
                                   Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
