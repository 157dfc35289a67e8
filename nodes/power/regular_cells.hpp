// The regular triangulation of weighted points (thesis, 2.5) as two flat tables.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "types/power_diagram.hpp"

namespace ballflow::geometry {

struct RegularCells {
  static constexpr std::int32_t infinite = -1;  // the vertex at infinity
  static constexpr std::int32_t none = -2;      // fills cells of fewer than four vertices

  // Dimension of the affine hull of the points; -1 for no points. In dimension d a cell has d + 1
  // vertices, and neighbor i lies opposite vertex i.
  int dimension = -1;
  // Point indices, `infinite` or `none`; in dimension 3 the vertices of a finite cell are positively
  // oriented. Cells whose vertices are all finite form the triangulation, the others close it to a sphere.
  // Their order has no meaning.
  std::vector<std::array<std::int32_t, 4>> cells;
  std::vector<std::array<std::int32_t, 4>> neighbors;  // cell indices

  std::size_t size() const { return cells.size(); }
};

/// Cells and neighbours wherever they are kept; all that is said about RegularCells but the order holds for
/// both.
struct CellTable {
  CellTable(const RegularCells& flat)  // NOLINT(google-explicit-constructor): a view
      : dimension(flat.dimension), cells(flat.cells), neighbors(flat.neighbors) {}
  CellTable(const PowerDiagram& diagram)  // NOLINT(google-explicit-constructor): a view
      : dimension(diagram.dimension), cells(diagram.cells), neighbors(diagram.neighbors) {}

  int dimension;
  std::span<const std::array<std::int32_t, 4>> cells, neighbors;

  std::size_t size() const { return cells.size(); }
};

/// Triangulates points `centers` with weights `weights` (squared model units).
/// - Cell sets are unique, for degenerate input too: ties are broken symbolically, and of points at one
///   place the heaviest stays, the one of lowest index among equals.
/// - A point whose power cell is empty (a hidden point) is in no cell.
/// - Coordinates and weights are finite; there are fewer than 2^31 points.
RegularCells regular_cells(std::span<const Vec3> centers, std::span<const double> weights, Monitor& monitor);

}  // namespace ballflow::geometry
