// A check from geometry that ellipsoids cover samples, and of the bound on how few could.
#pragma once

#include "base/monitor.hpp"
#include "types/cover_check.hpp"
#include "types/cover_state.hpp"
#include "types/ellipsoids.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// What has to be covered: points, or the triangles of `patches` where there are any, as for
/// ellipsoid_matrix(). Every one is held against every ellipsoid whose box it is in, without the tree behind
/// the matrix; only the definition of "in" is shared.
///
/// With `cover` and `candidates`, the ellipsoids of its matrix:
///   - what the cover lists as uncovered may be in no ellipsoid, and has to be in none of the candidates;
///   - its certificate is checked (conditions (1) to (3) of CoverState), and its bound goes into the result.
/// Throws InputError for what else is in no ellipsoid, naming the first, for a broken certificate, and for
/// inputs that do not fit each other.
CoverCheck verify_ellipsoids(const Ellipsoids& ellipsoids, const PointSet& points,
                             const TriangleMesh& patches, const CoverState* cover,
                             const Ellipsoids* candidates, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
