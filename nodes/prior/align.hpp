// Where a shape lies on another one of its kind, from samples without labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/monitor.hpp"
#include "types/point_set.hpp"
#include "types/shape_pose.hpp"

namespace ballflow::geometry {

enum class Reflections { refuse, allow };
enum class Extent {
  whole,  // both are whole shapes
  part,   // what is moved is a part of the target: nothing is asked of what it lacks
};

struct AlignOptions {
  bool similarity = true;  // the scale is free; else rotation and translation only
  Reflections reflections = Reflections::refuse;
  Extent extent = Extent::whole;
  // The share of the nearest pairs, in each direction, that transforms are fitted to. Below 1 what one shape
  // has and the other has not does not pull, but neither does a small feature that tells one end from the
  // other.
  double keep = 1;
  // Second best by best residual below which the pose is told to be ambiguous.
  double sure = 1.1;
  // Relative residual (relative_residual) above which the shape is told to be of another kind than the
  // target.
  double alike = 0.05;         // of a part, half of it: it has one of the two residuals
  std::int64_t points = 1000;  // of each shape; more samples than this are thinned evenly
};

/// The transform that lays `moved` on `target`: from all proper sign choices of the principal axes (with
/// permutations where lengths are nearly equal; from evenly spread rotations where only a part is there),
/// iterated closest points both ways, of the resulting optima the one with the smallest residual. Mirroring
/// transforms are found beside them, to tell mirror images; of a part only where they are allowed.
///
/// - `moved`, `target`: 4 points or more that span space, spread over the whole surfaces; normals are not
/// used
/// - the scale of a part, whose size says nothing, is looked for near 1: it has to be in the target's unit
/// - warns of a second pose that is nearly as good, and of a shape that is not like the target
///
/// Throws InputError for too few points, points in one plane, and with Reflections::refuse for a whole shape
/// that fits clearly better mirrored. [Besl and McKay 1992; Chetverikov et al. 2002]
ShapePose align(const PointSet& moved, const PointSet& target, const AlignOptions& options,
                Monitor& monitor = no_monitor());

/// The residual of the best pose that does not mirror, by the target's radius, found with a few hundred
/// points only: for choosing among many shapes. Precondition: as for align, which refuses.
double rough_residual(const PointSet& moved, const PointSet& target, const AlignOptions& options,
                      Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
