// Where rays meet balls, capsules and triangles. All in doubles and without libm but for sqrt, so that
// pictures are the same on every machine.
#pragma once

#include <optional>

#include "base/vec3.hpp"

namespace ballflow::show {

struct Ray {
  geometry::Vec3 origin, direction;  // the direction has length 1

  geometry::Vec3 at(double t) const { return origin + t * direction; }
};

/// Part of a ray; empty when lower > upper.
struct Interval {
  double lower = 0, upper = 0;
};

struct Ball {
  geometry::Vec3 center;
  double radius = 0;
};

/// All points within `radius` of the segment from a to b.
struct Capsule {
  geometry::Vec3 a, b;
  double radius = 0;

  /// The place of the point of the segment that is nearest to p: 0 at a, 1 at b.
  double place(geometry::Vec3 p) const;
};

struct Triangle3 {
  geometry::Vec3 a, b, c;
};

/// Where a ray meets a triangle: a distance, and the weights of b and c at the point.
struct TriangleHit {
  double t = 0, of_b = 0, of_c = 0;
};

/// The part of the whole line that lies in the ball; nothing when it misses the ball.
std::optional<Interval> inside(const Ray& ray, const Ball& ball);

/// Where the line enters the capsule.
std::optional<double> entry(const Ray& ray, const Capsule& capsule);

/// Where the line meets the triangle, from either side. A line through an edge or vertex that triangles share
/// meets at least one of them. Degenerate triangles are never met.
std::optional<TriangleHit> meeting(const Ray& ray, const Triangle3& triangle);

}  // namespace ballflow::show
