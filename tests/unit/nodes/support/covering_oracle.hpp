// Whether balls cover a ball, by trying every place where they may not, with exact numbers.
#pragma once

#include <span>

#include "power/contribution.hpp"

namespace ballflow::geometry::test {

/// Whether the closed ball lies in the union of the closed balls `others`, in a space of 3 dimensions, or in
/// the plane z = 0 of 2. For centers and weights of moderate size.
///
/// The least power to the others is a convex function on each of their cells, so on the ball it is largest at
/// an extreme point of the ball cut by a cell: where as many bisectors meet as there are dimensions, or on
/// the sphere, where it is largest in the intersection of the sphere with some bisectors. These points are
/// p + q sqrt(d) with rational numbers.
bool covered_by_enumeration(const Site& ball, std::span<const Site> others, int dimensions);

}  // namespace ballflow::geometry::test
