// The connected components of what a union of balls leaves of space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// Components of the complement of a union of balls with dual complex K, by Alexander duality the
/// components of the cells of the regular triangulation that are not in K, joined through triangles not in K.
/// K lies in the union, so the union is left by nothing that leaves K.
class Voids {
 public:
  static constexpr std::int32_t outer = 0;
  using Cell = std::array<std::int32_t, 4>;

  /// Keeps a reference.
  Voids(const PowerDiagram& diagram, Monitor& monitor);

  /// The outer one included, which has number 0; the others follow by their smallest cells.
  std::int32_t count() const { return static_cast<std::int32_t>(cells_of_.size()); }
  /// Finite cells of a void as ascending balls, in lexicographic order. Cells of the outer one as well.
  const std::vector<Cell>& cells_of(std::int32_t v) const { return cells_of_[static_cast<std::size_t>(v)]; }

  /// Where something lies: in a void, and there in a cell of the triangulation.
  struct Place {
    static constexpr std::int32_t outside = -1;  // of all finite cells
    std::int32_t number = outer;
    std::int32_t cell = outside;
  };
  /// Entry v is the place in `other`, a union that lies in this one, of a point of void v.
  std::vector<Place> inside(const Voids& other) const;

  /// The place of a point outside of the union; number -1 where it lies in the dual complex, hence in the
  /// union.
  Place place_of(Vec3 point) const;

  /// The void that a cell of the diagram is part of, -1 where the cell is in K.
  std::int32_t number_of(std::size_t cell) const { return label_[cell]; }
  /// The facet opposite corner k of a cell is not in K: it joins two cells of one void.
  bool open(std::size_t cell, std::size_t k) const { return (diagram_.in_complex[cell] >> k & 1) == 0; }

  /// Cells on a shortest way between two places in one void, as `cells_of` has them.
  std::vector<Cell> between(const Place& a, const Place& b) const;

 private:
  Place located(const Cell& orthogonal_to, const Voids& other) const;
  template <class ExactPoint>
  Place diagram_place(const ExactPoint& point) const;
  const PowerDiagram& diagram_;
  std::vector<std::int32_t> label_;  // per cell, -1 for cells in K
  std::vector<std::vector<Cell>> cells_of_;
};

/// Where four balls have equal power, and how much, rounded; not finite where the cell is flat.
struct PowerVertex {
  Vec3 point;
  double power = 0;
};
PowerVertex power_vertex(const SimplicialComplex& complex, const Voids::Cell& cell);

}  // namespace ballflow::geometry
