// Points and meshes under a scaling, and back.
#pragma once

#include "types/point_set.hpp"
#include "types/scaling.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class ScalingDirection : std::uint8_t {
  forth,  // to where the object is stretched
  back,   // to its own space
};

/// Every point is mapped; triangles stay. Normals of points are mapped as normals, by the inverse transpose,
/// and have length 1 again. There and back moves a point by rounding alone: about 2^-50 of the largest
/// coordinate.
/// Throws InputError for inputs that break their invariants, for coordinates that leave the range of doubles,
/// and where two points become equal by rounding (naming both).
PointSet apply_scaling(const PointSet& points, const Scaling& scaling, ScalingDirection direction);
TriangleMesh apply_scaling(const TriangleMesh& mesh, const Scaling& scaling, ScalingDirection direction);

}  // namespace ballflow::geometry
