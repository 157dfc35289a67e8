// A polyline in space: what something moves along.
#pragma once

#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Points joined by straight segments, and a radius at each, in between linear: the path is all balls with
/// such a radius around points of the polyline.
struct Path {
  Array<Vec3> points;   // n x 3, model units; finite, at least one, two that follow each other differ
  Array<double> radii;  // n, model units, >= 0

  // The balls that PathBalls made of it; 0 for none.
  std::int64_t balls = 0;
  double spacing = 0;         // centers that follow each other are no farther apart, model units
  std::uint8_t contains = 1;  // 1: the union of the balls contains the path; 0: it lies in the path
  // No point of the one is farther than that from the other, model units.
  double error = 0;

  std::size_t size() const { return points.size(); }
};

double length(const Path& path);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const Path& path);

}  // namespace ballflow::geometry
