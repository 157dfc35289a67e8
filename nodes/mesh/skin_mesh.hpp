// The skin surface of balls (Edelsbrunner 1999), on CGAL's mixed complex.
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// The skin surface that touches the balls and contains them: smooth where spheres meet, the more the smaller
/// `shrink` is; towards 1 it is the boundary of the union. It has the topology of the boundary of the union
/// of the balls grown by the factor 1 / sqrt(shrink).
/// - The triangles separate the corners of CGAL's triangulated mixed complex, and their corners lie on the
/// surface; they are not refined.
/// - A closed manifold for any balls, faces counter-clockwise seen from outside. Vertices and triangles are
/// in lexicographic order, so the same balls give the same bytes.
/// - Precondition: at least one ball; balls in general position, because ties of the mixed complex are broken
/// by addresses. `shrink` is above 0 and below 1.
/// - Throws InputError where there would be more than `most_faces`.
TriangleMesh skin_mesh(const Balls& balls, double shrink, std::size_t most_faces, Monitor& monitor);

}  // namespace ballflow::geometry
