// Whether a ball contributes, by trying everything with rational numbers.
#pragma once

#include <span>

#include "power/contribution.hpp"

namespace ballflow::geometry::test {

/// Enumerates the vertices of the closed power cell, cut by a large box: the open cell is empty unless their
/// mean is in it. Then the projections of the center onto all planes, lines and vertices of the cell.
bool contributes_by_enumeration(const Site& site, std::span<const Site> others);

}  // namespace ballflow::geometry::test
