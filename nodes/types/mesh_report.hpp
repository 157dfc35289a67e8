// How a mesh of the boundary of a union of balls was made, and what holds of it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace ballflow::geometry {

/// How a mesh was made in the end.
enum class MeshedBy : std::uint8_t {
  exact = 0,  // from the power diagram of the balls
  exact_grown =
      1,     // from that of balls that grew or shrank a little, because rounding would decide otherwise
  grid = 2,  // from cells of a grid
  skin = 3,  // the skin surface, which is not the boundary
};
std::string_view in_words(MeshedBy how);

struct MeshReport {
  std::uint8_t made_by = 0;  // MeshedBy
  std::int64_t vertices = 0, faces = 0;
  std::int64_t components = 0;  // of the mesh
  std::int64_t euler = 0;       // Euler characteristic of the mesh
  std::int64_t surfaces = 0;    // components of the boundary of the union that was meshed
  // Euler characteristic of the union of the balls as they were given, and of the union that was meshed.
  std::int64_t euler_given = 0, euler_meshed = 0;
  std::uint8_t closed = 0, manifold = 0, oriented = 0;  // 1 or 0: see MeshTopology

  double error_asked = 0;  // model units
  double error = 0;        // the largest distance of a triangle from the boundary of the union that was found
  // Of a grid, a skin surface and a simplified mesh: the largest distance from the mesh that a place of the
  // boundary was found to have, in the bottom of notches; -1: not measured, because method exact keeps both
  // ways within error_asked
  double error_back = -1;
  std::int64_t faces_before = 0;  // simplification; 0: there was none
  double growth = 0;              // the most that a radius grew, or shrank where it is negative, model units
  double cell = 0;                // edge of a cell of the grid, model units; 0 without a grid
  std::int64_t rounds = 0;        // how often arcs were divided again, or the grid was refined
  std::int64_t self_intersections = -1;  // pairs of triangles that cross; -1: not counted

  /// Betti numbers of the union that was meshed.
  void set_union(const std::array<std::int64_t, 3>& betti) {
    surfaces = betti[0] + betti[2];
    euler_meshed = betti[0] - betti[1] + betti[2];
  }
  /// The boundary of a solid has twice its Euler characteristic.
  bool right_topology() const {
    return closed != 0 && manifold != 0 && oriented != 0 && components == surfaces &&
           euler == 2 * euler_meshed;
  }
};

/// What is not as it was asked for, in words; empty when all is.
std::string what_differs(const MeshReport& report);

/// Empty when the numbers can be true, else what is wrong.
std::string broken_invariant(const MeshReport& report);

}  // namespace ballflow::geometry
