// Where one shape lies on another: a similarity transform, and how sure it is.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// x -> scale * rotation * x + translation, from the coordinates of what was moved to those of what it was
/// aligned to, the target.
struct ShapePose {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  // rows; orthogonal, determinant +1, or -1 below
  double scale = 1;                                           // above 0; 1 where `similarity` is 0
  Vec3 translation;                                           // model units of the target

  // How well it fits: root mean square of the distances of samples from the nearest ones of the other shape,
  // after trimming, model units of the target. Forward from what was moved to the target, backward the other
  // way; where only a part was moved, backward is not looked at and 0.
  double forward = 0, backward = 0;
  double diagonal = 0;  // of the bounding box of the target's samples: what the two are to be compared with

  // The residual of the best pose that is another one (turned against this one by more than a few degrees),
  // divided by the residual of this one: at least 1, and 1 is ambiguous. 0: all starts ended here.
  double second_best = 0;
  // The same of the best pose that mirrors: below 1 the shape looks like a mirror image. 0: not looked for.
  double mirror_image = 0;

  std::int32_t starts = 0;  // poses that the search began from; 0: the transform was given, or is labelled
  std::uint8_t similarity = 0;  // 1: the scale was free, too
  std::uint8_t mirrored = 0;    // 1: the rotation has determinant -1, because reflections were asked for
};

Vec3 transformed(const ShapePose& pose, Vec3 point);
/// A direction: turned (and mirrored), neither scaled nor moved.
Vec3 turned(const ShapePose& pose, Vec3 direction);
/// From the coordinates of the target to those of what was moved; only the transform, no residuals.
ShapePose inverse(const ShapePose& pose);

/// The angle between two rotations, degrees, in [0, 180]. Of one that mirrors and one that does not: 180.
double degrees_between(const ShapePose& a, const ShapePose& b);

/// Root of the sum of the squares of the two residuals, as part of the diagonal; 0 where that is not known.
double relative_residual(const ShapePose& pose);

/// Empty when the invariants above hold, else what is wrong.
std::string broken_invariant(const ShapePose& pose);

}  // namespace ballflow::geometry
