// A surface through denoised samples, put back onto the samples as they came.
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/point_set.hpp"
#include "types/surface_report.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Every vertex of `mesh` that is the centre of a ball moves to the sample that defines the ball, as it is in
/// `original`; midpoints of edges stay. The triangles stay: closed, oriented and manifold as they were.
/// Where samples moved farther than triangles are wide some may now cross. A mesh of samples that never moved
/// keeps its bytes.
///
/// - `report`: of the surface, with the ball of each vertex
/// - `balls`: those of its power diagram, each with one defining sample
///
/// Throws InputError for reports of other meshes or balls, and balls of other samples.
TriangleMesh restore_samples(const TriangleMesh& mesh, const SurfaceReport& report, const Balls& balls,
                             const PointSet& original);

}  // namespace ballflow::geometry
