// Betti numbers along a pipeline: of the solid that a surface bounds, of unions of balls, of the medial axis.
#pragma once

#include <optional>
#include <string>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/medial_axis.hpp"
#include "types/simplicial_complex.hpp"
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

/// What is there of the stages of a pipeline; null for what is not.
struct TopologyInputs {
  const TriangleMesh* surface = nullptr;
  const Balls* inner = nullptr;     // polar balls, taken with the tolerance `polar` of AlphaShape
  const Balls* enlarged = nullptr;  // taken as they are
  const Balls* kept = nullptr;      // taken as they are; not needed where `complex` is their alpha-shape
  const SimplicialComplex* complex = nullptr;
  const MedialAxis* axis = nullptr;
};

/// One row per stage that is there; a surface without triangles (a cloud of points) is not. Everything that
/// differs is a warning in words, and so is a surface whose topology is unknown.
/// - Throws InputError when nothing is there, and for balls that break their invariants.
TopologyTable topology(const TopologyInputs& stages, Monitor& monitor);

}  // namespace ballflow::geometry
