// How far the boundary of a union of balls is from a mesh of it, and the mesh from the boundary.
#pragma once

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// The largest distance from the mesh of the places of the boundary where a mesh of cells is farthest from
/// it: the corners where three spheres meet, the arcs where two do, cut in at least two chords not farther
/// than a quarter of `spacing` from them, and 26 places of spheres so small that a grid may miss them, of
/// radius up to 8 spacings. `at_least` where no place is that far: those nearer are not told apart, which
/// makes it fast. All in model units. `complex` is the dual complex of the balls, that of `diagram`. Places
/// that rounding may have put inside another ball are left out. The same for any number of threads.
/// Precondition: the mesh has a triangle.
double boundary_gap(const Balls& balls, const PowerDiagram& diagram, const SimplicialComplex& complex,
                    const TriangleMesh& mesh, double spacing, double at_least, Monitor& monitor);

/// The largest distance of the mesh from the boundary of the union that is found at its corners, in the
/// middle of its edges and triangles, half way from there to the corners, and at the eighths of those edges
/// of which the middle is far; model units.
double mesh_gap(const Balls& balls, const TriangleMesh& mesh, Monitor& monitor);

}  // namespace ballflow::geometry
