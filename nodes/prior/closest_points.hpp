// Iterated closest points between two clouds.
#pragma once

#include "prior/cloud.hpp"
#include "types/shape_pose.hpp"

namespace ballflow::geometry {

struct ClosestPointsOptions {
  bool similarity = true;
  bool both_ways = true;  // else the moved cloud is a part of the target: only its own points are looked at
  double keep = 0.9;      // share of the nearest pairs of each direction that count
  int most_steps = 60;
  double stop = 1e-5;  // relative change of the squared residual
};

/// Moves from `start` (mirroring ones stay so) to the next minimum. Residuals are those of the result, over
/// the kept pairs.
ShapePose iterate_closest_points(const Cloud& moved, const Cloud& target, const ShapePose& start,
                                 const ClosestPointsOptions& options, Monitor& monitor);

/// Root mean square distances of the share `keep` of nearest pairs: forward and backward of `pose`.
void measure(ShapePose& pose, const Cloud& moved, const Cloud& target, double keep, bool both_ways);

/// What optima are compared by: of both directions, or of the one there is.
double residual_of(const ShapePose& pose);

}  // namespace ballflow::geometry
