// The connected components of a closed surface, and which lies in which.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "types/topology_table.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A component: triangles that are connected by vertices.
struct Shell {
  std::int32_t corner = 0;  // one of its vertices
  std::int64_t vertices = 0, triangles = 0;
  std::int64_t genus = 0;
  double area = 0;
  double volume = 0;  // inside it; negative as long as its triangles face inwards
  Box box;
  // How often others wind around `corner`, by their number; those that do not are left out.
  std::vector<std::pair<std::int32_t, std::int64_t>> winding;
  std::int32_t parent = -1;  // the smallest one that it lies in, or none

  bool faces_outwards = true;  // in the solid: where its triangles face, unless it is turned
  bool turned = false;         // faces inwards in the file, and bounds no cavity
  /// Of the solid: on one of its sides is inside, on the other one outside.
  bool bounds = true;
};

/// The solid of points around which the surface winds: at least once, when components that face inwards and
/// do not lie in one that faces outwards are turned over, and the whole surface first, when its volume is
/// negative.
struct Shells {
  std::vector<Shell> shells;        // in the order of their first triangles
  std::vector<std::int32_t> shell;  // of every triangle
  bool inside_out = false;          // all of them were turned over first

  /// b0 counts the shells that bound the solid from outside, b2 those that bound it from inside, b1 is the
  /// sum of their genera (Alexander duality). Right for surfaces that do not intersect themselves.
  Betti betti() const;
  /// Of the solid, cavities taken off; cubed model units. Of surfaces that intersect themselves it is what
  /// the formula gives.
  double volume() const;
  double area() const;
};

/// Precondition: every edge is run through once in both directions, and the mesh keeps its invariants.
Shells shells_of(const TriangleMesh& surface, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
