// Volume, area, centre of mass and inertia tensor of a union of balls.
//
// The boundary of the union consists of one patch on the sphere of each ball; its edges are arcs of the
// circles in which two spheres meet, its corners the points of three. The dual complex names them all
// (Edelsbrunner 1995), so nothing is searched or sampled. By the divergence theorem every integral over the
// union is one over the patches, of polynomials in the outward unit normal n; those, on the unit sphere, are
// integrals over the arcs:
//
//   solid angle   W     = 2 pi X - integral of the geodesic curvature - exterior angles   (Gauss and Bonnet)
//   moments       N_a   = -1/2 integral of v_a
//                 M_ab  = (d_ab W - integral of n_b v_a) / 3
//                 T_abc = (d_ab N_c + d_ac N_b - integral of n_b n_c v_a) / 4
//
// v is the normal of the arc in the sphere that points out of the patch, d Kronecker's delta, and X the Euler
// characteristic of the patch: 2 minus that of the link of the ball in the complex. The last three are the
// divergence theorem on the sphere for the tangential parts of constant, linear and quadratic fields.
#pragma once

#include <optional>
#include <string>

#include "base/monitor.hpp"
#include "types/mass_properties.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Of the union of the balls |x - centers[i]|^2 <= weights[i]; `complex` is its dual complex (alpha_shape).
/// Exact formulas in doubles: the relative error is about 1e-13 times the number of balls that meet in a
/// place, and closure_error shows when cancellation made it worse. Decisions are exact predicates on the
/// complex. Accepts every complex with its invariants: empty, flat, touching balls, radius 0, cavities, many
/// components. Time is linear in the size of the complex.
MassProperties union_measure(const SimplicialComplex& complex, Monitor& monitor = no_monitor());
/// The same, bit by bit, where the power diagram is at hand that the complex was read off. InputError when it
/// is another one.
MassProperties union_measure(const SimplicialComplex& complex, const PowerDiagram& diagram,
                             Monitor& monitor = no_monitor());

struct SolidVolumeOptions {
  double tolerance = 5;  // % of the volume of the solid: a larger difference is worth a warning
};

/// The volume of the solid inside a mesh, by the divergence theorem, and how far that of a union is off.
struct SolidVolume {
  double volume = 0;    // cubed model units
  double error = 0;     // (union - solid) / solid
  bool exact = true;    // by formula; else counted on lines, to about a thousandth
  std::string warning;  // why to worry and what to do, in words; or empty
};
/// The volume of what the surface winds around, once or several times: of shells in each other, crossing
/// pieces, triangles that are there twice. Nothing where the mesh is not closed or has no volume.
std::optional<SolidVolume> compare_volume(const MassProperties& of_union, const TriangleMesh& solid,
                                          const SolidVolumeOptions& options, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
