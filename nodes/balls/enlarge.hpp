// Growing balls, so that a later covering step may drop small features (thesis, 3.5).
#pragma once

#include "types/balls.hpp"
#include "types/vec3.hpp"

namespace ballflow::geometry {

/// How a radius r becomes the enlarged radius.
enum class EnlargeMode {
  additive,        // r + epsilon / 100 * longest edge of the bounding box of the sample (thesis, 3.9.2)
  absolute,        // r + epsilon
  multiplicative,  // r * factor
};

struct EnlargeOptions {
  EnlargeMode mode = EnlargeMode::additive;
  // additive: % of the longest bounding-box edge; absolute: model units. At least 0, where 0 returns the
  // input; from about 0.1 % on features of a scan begin to disappear, from about 3 % on most of the shape.
  double epsilon = 0.3;
  // multiplicative: at least 1, where 1 returns the input.
  double factor = 1.05;
};

/// The enlarged balls: same order, same centers, same defining samples, no radius smaller than before.
/// `sample_box` is the bounding box of the sample, the unit of the additive mode; the others ignore it.
/// Growth by the same length everywhere gives noise the same significance everywhere; growth by a factor
/// spares thin parts.
/// Throws InputError for options out of range, an empty `sample_box` where it is needed, balls that break
/// their invariants, and radii that leave the range of doubles.
Balls enlarge(const Balls& balls, const Box& sample_box, const EnlargeOptions& options);

}  // namespace ballflow::geometry
