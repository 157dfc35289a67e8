// The covering matrix of ellipsoids and samples: what the strategies of pruning choose from.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/cover_state.hpp"
#include "types/ellipsoids.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct EllipsoidMatrixOptions {
  std::int64_t max_entries = 500'000'000;  // 4 bytes each; a larger matrix is refused
};

/// Entry (i, j) is 1 iff sample j lies in ellipsoid i (Ellipsoid::contains). With triangles in `patches`
/// these are the columns: one is covered by an ellipsoid that contains its corners, and so contains it whole.
///
/// - Nothing is chosen; every ellipsoid is a row, also one that covers nothing. Its "balls" are ellipsoids.
/// - Samples in no ellipsoid are in no column, listed in `uncovered`, and warned about.
/// - The lower bound of the result is ceil(columns / longest row).
/// - The result does not depend on the number of threads.
///
/// Throws InputError for inputs that break their invariants, a matrix of more than `max_entries` entries, or
/// one larger than the memory granted.
CoverState ellipsoid_matrix(const Ellipsoids& ellipsoids, const PointSet& points, const TriangleMesh& patches,
                            const EllipsoidMatrixOptions& options = {}, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
