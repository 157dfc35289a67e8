// A number of balls handed out to several objects, so that all of them together waste little volume.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "types/ball_counts.hpp"
#include "types/enclosure_fit.hpp"

namespace ballflow::geometry {

struct AllocateBallsOptions {
  std::int64_t balls = 220;           // of all objects together
  std::int64_t minimum = 1;           // of each one
  std::vector<double> weights{};      // per object: how much its volume counts; empty: 1 each
  std::vector<std::int64_t> fixed{};  // per object: as many balls, 0 where they are to be found; empty: none
};

/// `fits`: those of the first object, with more and more balls wanted, then those of the second one, and so
/// on: an object begins where fewer balls are wanted than before, or as many.
///
/// A fit counts for the balls it uses. Between two fits the volume outside is taken for linear in
/// 1 / sqrt(k), which is how it falls where edges dominate; beyond the last one for proportional to that, or,
/// where that did not use all balls it might, for constant. Of all ways to hand out the balls this is one
/// with the least weighted sum, by dynamic programming; what nobody can use is left. Beyond 4096 balls they
/// go out in blocks of equal size, and less than one block is left.
/// - Throws InputError where the numbers of weights or fixed counts are not those of the objects, and where
/// fixed counts and minima are
///   more than all balls.
BallCounts allocate_balls(std::span<const EnclosureFit> fits, const AllocateBallsOptions& options);

/// The number in the counts of one object. InputError where they are not one.
std::int64_t only_count(const BallCounts& counts);

/// The count of one object. InputError where there is no such object.
BallCounts count_of(const BallCounts& counts, std::int64_t object);

}  // namespace ballflow::geometry
