// Creases in a mesh of a union of balls: where two spheres meet, or three.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "search/box_tree.hpp"
#include "types/balls.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Splits those of the triangles, in place, whose corners lie on different spheres.
/// - `spheres` says for each vertex on which sphere it lies; `tree` holds the centers, with radii as slacks.
///   Lengths are in model units. Edges are about as long as `cell`.
/// - An edge between two spheres is split at the place of their circle that is nearest to where the edge goes
///   from one to the other, or above it where other balls fill the notch; a triangle between three spheres at
///   their common point. Only where that is at least a fifth of a cell away, at most three, and on the
///   boundary of the union.
/// - A closed, oriented manifold stays one, of the same Euler characteristic. Its triangles may cross; splits
///   that fold triangles are left out where the bottom of the notch is within a quarter of a cell.
/// Returns the largest distance from the boundary that was found in the middle of the edges and triangles
/// that came and of those between different spheres that stayed, and half way to the corners. The same for
/// any number of threads. Throws InputError for more than 2^31 - 1 vertices.
double add_creases(const Balls& balls, const BoxTree& tree, std::span<const std::int32_t> spheres,
                   double cell, std::vector<Vec3>& vertices, std::vector<Triangle>& triangles,
                   Monitor& monitor);

}  // namespace ballflow::geometry
