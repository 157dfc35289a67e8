// The power diagram of a set of balls by its dual, the regular triangulation (thesis, 2.5), and which of its
// simplices belong to the dual complex of the union.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow::geometry {

struct PowerDiagram {
  static constexpr std::int32_t infinite = -1;   // the vertex at infinity
  static constexpr std::int32_t none = -2;       // fills cells of fewer than four vertices
  static constexpr std::uint8_t whole = 1 << 4;  // of `in_complex`

  // Ball i is { x : |x - centers[i]|^2 <= weights[i] }.
  Array<Vec3> centers;    // n x 3, model units
  Array<double> weights;  // n, squared model units, delta included
  double delta = 0;       // added to every squared radius before anything was decided

  // Dimension of the affine hull of the centers; -1 for no balls. In dimension d a cell has d + 1 vertices,
  // and neighbor k lies opposite vertex k.
  std::int32_t dimension = -1;
  // c x 4: balls, `infinite` or `none`. Cells whose vertices are all finite form the triangulation, the
  // others close it to a sphere. In dimension 3 cells are positively oriented and their vertices ascend, but
  // for the last two where they must be exchanged for that; in lower dimensions they ascend. Cells are in
  // lexicographic order of their ascending vertices: infinite cells come first.
  Array<std::array<std::int32_t, 4>> cells;
  Array<std::array<std::int32_t, 4>> neighbors;  // c x 4: indices of cells, or `none`
  // c: bit 4 where the cell belongs to the dual complex of the union (its balls have a point in common where
  // their power cells meet), bit k in dimension 3 where its facet opposite vertex k does.
  Array<std::uint8_t> in_complex;

  std::size_t size() const { return cells.size(); }
};

/// Empty when the invariants above hold, else what is wrong and where. Whether the triangulation is regular,
/// and the flags right, is not looked at.
std::string broken_invariant(const PowerDiagram& diagram);

}  // namespace ballflow::geometry
