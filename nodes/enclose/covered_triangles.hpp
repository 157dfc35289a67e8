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
  /// How far the farthest corner is from the union; 0 where all are in it. Precondition: there are balls.
  double gap_of_corners(const Corners& triangle) const;
  /// Parts no longer than `size`; in doubles. Of a gap that is not above `settled`, that is all one learns.
  /// Precondition: there are balls.
  UncoveredPart uncovered(const Corners& triangle, double size, double settled) const;
  /// No point of the triangle is farther from the union than this, up to rounding, and it is at most
  /// `tolerance` above the largest distance, or above `settled`, whichever is more. (Beyond a million parts
  /// it may be more above.) Precondition: there are balls.
  double gap_at_most(const Corners& triangle, double settled, double tolerance) const;

 private:
  bool none_meets(const Corners& part, Vec3 center, double radius) const;
  std::vector<std::int32_t> meeting(const Corners& triangle) const;
  /// At most `at_most`; where it is below `enough`, some value below that.
  double distance_from_union(Vec3 p, double at_most, double enough) const;

  std::span<const Vec3> centers_;
  std::span<const double> radii_;
  BoxTree tree_;
};

}  // namespace ballflow::geometry
