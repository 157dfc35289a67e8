// Whether triangles lie in a union of balls, by bisection.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "search/box_tree.hpp"
#include "types/balls.hpp"
#include "types/enclosure.hpp"

namespace ballflow::geometry {

using Corners = std::array<Vec3, 3>;

/// What bisecting a triangle found.
struct TriangleCover {
  std::int64_t pieces = 0;             // that lie in one ball each
  std::optional<OpenTriangle> open{};  // nothing: it lies in the union
  Vec3 point;                          // of an open one, rounded
};

/// How much of a triangle is in no ball, by parts of a given size.
struct UncoveredPart {
  double area = 0;
  double gap = 0;  // farthest of their corners and centroids from the union
};

/// Balls in a tree, for triangles. Balls with radius 0 are points.
class BallsForTriangles {
 public:
  explicit BallsForTriangles(const Balls& balls);

  /// See verify_enclosure.hpp. Exact.
  TriangleCover cover(const Corners& triangle) const;
  /// Parts no longer than `size`; in doubles.
  UncoveredPart uncovered(const Corners& triangle, double size) const;
  /// No point of the triangle is farther from the union than this, up to rounding, and it is at most
  /// `tolerance` above the largest distance, or above `settled`, whichever is more. (Beyond a million parts
  /// it may be more above.) Precondition: there are balls.
  double gap_at_most(const Corners& triangle, double settled, double tolerance) const;

 private:
  std::vector<std::int32_t> meeting(const Corners& triangle) const;
  double distance_from_union(Vec3 p) const;

  std::span<const Vec3> centers_;
  std::span<const double> radii_;
  BoxTree tree_;
};

}  // namespace ballflow::geometry
