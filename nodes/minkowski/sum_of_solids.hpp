// The sum of two solids that balls stand for: what is proven of it, from which side.
#pragma once

#include "minkowski/minkowski_sum.hpp"
#include "minkowski/minkowski_sum_2.hpp"
#include "types/enclosure.hpp"

namespace ballflow::geometry {

/// What the balls of the sum are meant to be, so that rounding the sums works for it.
enum class SumMode {
  balanced,  // sums are rounded to nearest
  inner,     // every ball lies in the exact sum of its pair
  outer,     // every ball contains the exact sum of its pair
};

/// What VerifyEnclosure found of the balls of either side and the surface of its solid; null: the solid is
/// what its comparison says, or the union of its balls itself.
struct SolidEnclosures {
  const Enclosure* a = nullptr;
  const Enclosure* b = nullptr;
};

/// Balls whose radii are larger (outer) or smaller (inner) by `by`; those that would be smaller than 0 are
/// left out.
Balls moved_radii(const Balls& balls, SumMode mode, double by);

/// By how much the radii of either side move, so that a sum that is rounded to nearest contains the exact sum
/// of the balls as they were, or lies in it: 2^-48 of the largest coordinates and radii of a and b together.
/// Rounding moves a centre by at most sqrt(3) 2^-53 of that, and three radii by 2^-53 each.
double rounding_of_sums(const Balls& a, const Balls& b);

/// The minkowski_sum of a and b, rounded as `mode` asks for, and what follows for the solids A and B:
/// - A + B lies in the union where A lies in that of a and B in that of b (Enclosure::encloses), and sums are
///   rounded outwards. A is everything that the triangles are, or separate from infinity; they need not be
///   closed.
/// - The union lies in A + B where no ball of a reaches out of A, none of b out of B (protrusion 0, closed
///   meshes), and sums are rounded inwards.
/// - No point of the surface of A + B is farther from the union than error_bound: Enclosure::gap_at_most
///   stands beside what a Comparison says; the smaller one counts. 0 where the union contains A + B.
/// - No point of the union is farther from A + B than excess_bound, the sum of both protrusions, since a
///   point u + v is no farther from A + B than u is from A and v from B together. 0 inside.
/// Bounds other than 0 hold up to rounding, which is less than 2^-46 of the largest coordinates.
/// Throws what minkowski_sum throws, and InputError for a damaged enclosure.
MinkowskiSum sum_of_solids(const Balls& a, const Balls& b, SumMode mode, const SolidComparisons& compared,
                           const SolidEnclosures& enclosed, const MinkowskiSumOptions& options = {},
                           Monitor& monitor = no_monitor());

/// The same of discs and polygons: minkowski_sum_2 in place of minkowski_sum. Enclosures are those of balls
/// with z = 0 and the meshes of a polygon (planar/polygon_meshes.hpp).
MinkowskiSum2 sum_of_polygons(const Balls& a, const Balls& b, SumMode mode,
                              const PolygonComparisons& compared, const SolidEnclosures& enclosed,
                              const MinkowskiSum2Options& options = {}, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
