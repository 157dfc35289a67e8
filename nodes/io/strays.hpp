// Points that do not belong to the shape: zeros of a scanner, a marker far away.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct Strays {
  std::vector<std::int32_t> points;  // ascending
  double nearest = 0;                // the least distance of one from the middle of the others
  double diagonal = 0;               // of the box of the others
};

/// The few points that stretch the bounding box by an order of magnitude or more: at most a hundredth of all
/// (at least one), farther from the middle of the others' box than ten of its diagonals. The box of the
/// others is that of all points but the hundredth that is lowest and the one that is highest along each axis.
///
/// With triangles, points that a triangle joins with others are none: what is far away and connected is a
/// part of the model. None for fewer than 16 points. Points are finite.
Strays find_strays(std::span<const Vec3> points, std::span<const Triangle> triangles,
                   Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
