// The inclusion of a union of balls in a larger one, by brute force: nerves of the balls themselves (every
// set of balls with a common point), in exact rational arithmetic, and ranks over Z/2 by elimination. The
// nerve of a part of the balls is a part of the nerve, so nothing has to be followed from one complex to
// another.
#pragma once

#include <cstdint>
#include <span>

#include "homology/inclusion_homology.hpp"
#include "types/balls.hpp"

namespace ballflow::test {

/// For at most about 20 balls. Squared radii are the doubles radius * radius.
geometry::InclusionHomology cech_inclusion(const geometry::Balls& balls, std::span<const std::int32_t> part);

}  // namespace ballflow::test
