// Which cell of a regular triangulation a point lies in.
#pragma once

#include <cstdint>

#include "base/vec3.hpp"
#include "types/power_diagram.hpp"

namespace ballflow::geometry {

/// Walks from cell to cell, each time through a facet behind which the point lies, by exact predicates: in
/// a regular triangulation such a walk ends (Edelsbrunner 1990). Three dimensions only.
class CellWalk {
 public:
  /// Keeps a reference. Throws InputError for a diagram of fewer dimensions.
  explicit CellWalk(const PowerDiagram& diagram);

  /// A cell that contains p, found from cell `from`; an infinite one where p is outside of all finite cells.
  std::int32_t cell_of(Vec3 p, std::int32_t from) const;
  /// Some finite cell.
  std::int32_t any() const { return any_; }
  bool is_infinite(std::int32_t cell) const;

 private:
  const PowerDiagram& diagram_;
  std::int32_t any_ = -1;
};

}  // namespace ballflow::geometry
