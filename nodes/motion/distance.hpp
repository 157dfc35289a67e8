// How far two unions of balls are apart, or how deep they overlap.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/ball_distance.hpp"
#include "types/balls.hpp"
#include "types/enclosure.hpp"

namespace ballflow::geometry {

struct DistanceOptions {
  // Pairs of balls with at most this separation are listed, model units; 0: those that touch or overlap.
  double threshold = 0;
  std::int64_t most_pairs = 1000;  // of them those with the smallest separations; 0: none
  bool every_ball = false;         // also, for every ball of a and of b, how far the other set is
};

/// Proofs about the solids that the balls stand for, or null where the balls are the solid.
struct SolidsOfBalls {
  const Enclosure* a = nullptr;
  const Enclosure* b = nullptr;
};

/// The smallest separation of all pairs of a ball of a and one of b, the pairs below the threshold, and on
/// request the clearance of every ball.
/// - Accepts any balls, overlapping, nested, equal, concentric, of radius 0, in any order.
/// - Which pair, and which pairs, is decided exactly for the doubles given (exact/separation.hpp); of equal
///   separations the lowest index of a, then of b, comes first. Numbers and points are rounded.
/// - Throws InputError for an empty set, for coordinates or radii beyond 1e140, and for a proof that is about
///   another number of balls.
/// Two trees of boxes are descended at once, nearest boxes first (branch and bound).
BallDistance ball_distance(const Balls& a, const Balls& b, const DistanceOptions& options, Monitor& monitor,
                           const SolidsOfBalls& solids = {});

}  // namespace ballflow::geometry
