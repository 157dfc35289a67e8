#include "surface/cell_walk.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <string>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
Kernel::Point_3 point(Vec3 p) { return {p.x, p.y, p.z}; }

}  // namespace

CellWalk::CellWalk(const PowerDiagram& diagram) : diagram_(diagram) {
  if (diagram.dimension != 3) {
    throw InputError("the balls are in one " + std::string(diagram.dimension == 2   ? "plane"
                                                           : diagram.dimension == 1 ? "line"
                                                                                    : "point"),
                     "a closed surface needs samples on all sides of a solid");
  }
  while (any_ < 0 || is_infinite(any_)) ++any_;  // infinite cells come first, and there is a finite one
}

bool CellWalk::is_infinite(std::int32_t cell) const {
  for (const std::int32_t v : diagram_.cells[at(cell)]) {
    if (v == PowerDiagram::infinite) return true;
  }
  return false;
}

std::int32_t CellWalk::cell_of(Vec3 p, std::int32_t from) const {
  std::int32_t cell = from, before = -1;
  while (!is_infinite(cell)) {
    const auto& vertices = diagram_.cells[at(cell)];
    std::int32_t next = -1;
    for (std::size_t k = 0; k < 4 && next < 0; ++k) {
      const std::int32_t beside = diagram_.neighbors[at(cell)][k];
      if (beside == before) continue;
      std::array<Kernel::Point_3, 4> corners;
      for (std::size_t j = 0; j < 4; ++j) corners[j] = point(j == k ? p : diagram_.centers[at(vertices[j])]);
      if (CGAL::orientation(corners[0], corners[1], corners[2], corners[3]) == CGAL::NEGATIVE) next = beside;
    }
    if (next < 0) return cell;
    before = cell;
    cell = next;
  }
  return cell;
}

}  // namespace ballflow::geometry
