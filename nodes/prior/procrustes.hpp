// The transform that lays labelled points on others: Procrustes analysis of two shapes.
#pragma once

#include <cstddef>
#include <span>

#include "base/vec3.hpp"
#include "types/shape_pose.hpp"

namespace ballflow::geometry {

struct ProcrustesOptions {
  bool similarity = true;  // the scale is free; else rotation and translation only
  bool mirror = false;     // the best transform of determinant -1 instead of +1
};

/// The transform x -> s R x + t that makes the weighted sum of squared distances of the transformed `from[i]`
/// from `to[i]` smallest, by Horn's quaternions: never a reflection unless asked for, whatever the points.
/// Where several are best (points on a line, or one point) it is one of them; a scale that would be 0 or
/// below, or is not determined, is 1.
///
/// - n points each, n >= 1, finite; `weights` are n, >= 0 and not all 0, or none for equal ones
/// - the residual `forward` of the result is the weighted root mean square distance; no `starts`
///
/// Sums run in the order of the points. [Horn 1987; Gower 1975]
ShapePose labelled_pose(std::span<const Vec3> from, std::span<const Vec3> to, std::span<const double> weights,
                        const ProcrustesOptions& options = {});

}  // namespace ballflow::geometry
