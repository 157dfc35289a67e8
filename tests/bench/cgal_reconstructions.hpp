// Surfaces from clouds as CGAL makes them: the peers of reconstruct.json. A translation unit of its own,
// because it takes two minutes to compile.
#pragma once

#include <span>

#include "base/vec3.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::bench {

/// Advancing front (Cohen-Steiner and Da 2004) with CGAL's parameters.
geometry::TriangleMesh advancing_front(std::span<const geometry::Vec3> points);

/// Scale space (Digne et al. 2011): four steps of smoothing with CGAL's parameters, meshed by an advancing
/// front and put back on the points.
geometry::TriangleMesh scale_space(std::span<const geometry::Vec3> points);

/// Poisson (Kazhdan et al. 2006) with the average spacing of 6 neighbours, from points with normals. No
/// triangle where CGAL gives up.
geometry::TriangleMesh poisson(std::span<const geometry::Vec3> points,
                               std::span<const geometry::Vec3> normals);

}  // namespace ballflow::bench
