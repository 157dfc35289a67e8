// Betti numbers of the solid that a surface bounds.
#pragma once

#include <optional>
#include <string>

#include "base/monitor.hpp"
#include "types/topology_table.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// Betti numbers of the closed solid inside a surface, or why they are unknown.
struct SolidTopology {
  std::optional<Betti> betti;
  std::string unknown_because;  // "the surface is open (3 edges with one triangle)"; empty when known
};

/// A closed surface without self-intersections bounds a solid: the points around which it winds. Components
/// of negative volume bound cavities when they lie inside one of positive volume; others are turned outwards,
/// as LabelPoles does. b0 counts the components that bound the solid from outside, b2 those that bound it
/// from inside, b1 is the sum of their genera (Alexander duality). No triangles: no solid, all 0.
/// - Accepts any mesh that keeps its invariants; open, non-manifold, unorientable, self-intersecting meshes
///   and meshes with triangles without area are unknown.
SolidTopology solid_topology(const TriangleMesh& surface, Monitor& monitor);

/// The row `surface` of a topology table. A surface whose topology is unknown is a warning in words; one
/// without triangles (a cloud of points) has no row.
TopologyTable solid_row(const TriangleMesh& surface, Monitor& monitor);

}  // namespace ballflow::geometry
