// Whether there is a way between two points around a union of balls, as FindWay found it.
#pragma once

#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

enum class WayAnswer : std::uint8_t {
  way = 0,
  none = 1,          // start and goal are in different components of what the balls leave of space
  start_inside = 2,  // of a ball, or on its sphere
  goal_inside = 3,
  both_inside = 4,
};

/// What the balls are a bound of: the places where something would hit something else.
enum class WayProof : std::uint8_t {
  balls = 0,    // nothing but themselves
  contain = 1,  // they contain these places: a way is one of the solids, too
  inside = 2,   // they lie in them: where there is no way around the balls there is none
};

struct Way {
  std::int64_t balls = 0;
  Vec3 start, goal;         // model units
  std::uint8_t answer = 0;  // WayAnswer
  std::uint8_t proof = 0;   // WayProof
  // Components of the complement of the union: 0 is the unbounded one, the others are voids. -1: inside.
  std::int32_t components = 1, start_component = -1, goal_component = -1;
  // The ball that start or goal is deepest in, -1 for none.
  std::int32_t start_ball = -1, goal_ball = -1;

  // A polyline from start to goal that meets no ball: every segment was checked as if with real numbers.
  // Empty where there is no way, and where there is one that rounding closes.
  Array<Vec3> points;        // n x 3, model units
  Array<double> clearances;  // n: from the nearest ball, model units, rounded
  double clearance = 0;      // no point of the polyline is nearer to a ball, model units, rounded

  WayAnswer said() const { return static_cast<WayAnswer>(answer); }
};

/// Of the polyline.
double length(const Way& way);

/// "a way of length 3.2, nowhere nearer than 0.05 to a ball", "no way: ...", and what that proves.
std::string describe(const Way& way);

/// Empty when the invariants above hold, else what is wrong and where.
std::string broken_invariant(const Way& way);

}  // namespace ballflow::geometry
