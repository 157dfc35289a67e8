// Balls that a union can do without.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/balls.hpp"

namespace ballflow::geometry {

/// `returned` (ascending ids of `balls`) without balls whose absence changes no homology of the union of the
/// balls `kept` and `returned`: groups of neighbours, then one after the other, smaller ones first, are taken
/// out until the inclusion of the union without it would be no isomorphism over Z/2 for any that is left.
///
/// Let U be a union, b one of its balls and V the union of the others. V -> U is an isomorphism in homology
/// if and only if H(U, V) = 0, and H(U, V) = H(b, b cut with V) by excision. So only balls that meet b
/// decide: their union with and without b is compared (inclusion_homology.hpp), some ten balls instead of
/// all. The same holds for a group of balls.
///
/// Preconditions: ids are in range and in one of the lists only. The same for any order of the balls, but for
/// equal ones.
std::vector<std::int32_t> without_superfluous(const Balls& balls, std::span<const std::int32_t> kept,
                                              std::span<const std::int32_t> returned, Monitor& monitor);

}  // namespace ballflow::geometry
