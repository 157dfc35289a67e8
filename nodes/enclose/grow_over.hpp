// Balls that grow until every triangle of a mesh lies in them.
#pragma once

#include <span>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Raises radii so that every triangle is cut into parts that lie in one ball each. A part asks for the
/// least growth with which one ball holds its corners. Triangles are bisected at their longest edge until
/// parts ask for no more than `tolerance`, or 5 % of what the vertex asks for that asks for most, above what
/// one of their corners asks for; the parts that ask for
/// most choose first, each the ball that needs to grow least from where it is. No ball grows by more than the
/// most that a part asks for.
/// - Corners lie in their ball up to rounding: add a little to all radii.
/// - Precondition: tolerance (model units) above 0; as many centres as radii, one at least; triangles and
/// centres are finite.
/// - The same for any number of threads.
void grow_over(const TriangleMesh& mesh, std::span<const Vec3> centers, std::span<double> radii,
               double tolerance, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
