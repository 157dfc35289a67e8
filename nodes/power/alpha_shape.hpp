// The weighted zero alpha-shape of a set of balls: the dual complex of their union.
//
// Notation: the power of a point x to ball i is |x - c_i|^2 - w_i, w_i = r_i * r_i + delta. A simplex is a
// set of balls; its smallest orthogonal sphere is the smallest sphere (c, R^2) with |c - c_i|^2 - w_i = R^2
// for all of them (R^2 may be negative). The simplex is a Gabriel simplex when no other ball has
// |c - c_j|^2 - w_j < R^2. alpha = R^2 for Gabriel simplices of the regular triangulation, else the
// smallest alpha of a coface. The complex consists of the simplices with alpha <= 0 (Edelsbrunner 1995;
// thesis, 2.6) and is homotopy equivalent to the union of the closed balls.
#pragma once

#include "base/monitor.hpp"
#include "power/power_diagram.hpp"
#include "types/balls.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

using AlphaShapeOptions = PowerDiagramOptions;

/// The dual complex of `balls`, with classes of simplices and Betti numbers of the union.
/// - Accepts no ball, one ball, collinear and coplanar centers, radius 0, nested, touching, equal balls.
///   Touching is exact: closed balls with one point in common are joined.
/// - Of balls with one center only the largest can be a vertex (the lowest index among equals); a ball
///   whose power cell does not meet it is no vertex.
/// - Decisions are exact for the doubles `centers` and `weights` of the result.
/// - Where all centers lie in a plane no simplex is interior, and triangles are singular.
/// - Throws InputError for balls that break their invariants or have a radius whose square overflows.
SimplicialComplex alpha_shape(const Balls& balls, const AlphaShapeOptions& options, Monitor& monitor);

/// The same where the power diagram of the balls is known: nothing is triangulated.
SimplicialComplex alpha_shape(const PowerDiagram& diagram, Monitor& monitor);

}  // namespace ballflow::geometry
