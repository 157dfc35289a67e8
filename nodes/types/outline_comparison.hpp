// How far two polygons are from each other.
#pragma once

#include <cstdint>
#include <string>

namespace ballflow::geometry {

/// Areas are exact for the coordinates given, and rounded once; all are -1, unknown, where rings of a polygon
/// cross or touch. Lengths are in model units.
struct OutlineComparison {
  double area_a = 0, area_b = 0;  // of the insides
  double only_a = 0, only_b = 0;  // of what is inside one of them alone

  // The largest distance of a point of the boundary of a from that of b, and the other way round: the true
  // value lies between; 0 and 0 where both are empty.
  double a_to_b_at_least = 0, a_to_b_at_most = 0;
  double b_to_a_at_least = 0, b_to_a_at_most = 0;

  bool areas_known() const { return area_a >= 0; }
  double symmetric_difference() const { return only_a + only_b; }
  double hausdorff_at_most() const {
    return a_to_b_at_most > b_to_a_at_most ? a_to_b_at_most : b_to_a_at_most;
  }
};

/// Empty when the numbers can be true, else what is wrong.
std::string broken_invariant(const OutlineComparison& comparison);

}  // namespace ballflow::geometry
