// Which cells of the regular triangulation of surface balls are inside the solid.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/point_set.hpp"
#include "types/pole_set.hpp"
#include "types/power_diagram.hpp"

namespace ballflow::geometry {

struct CellLabels {
  std::vector<std::uint8_t> inside;  // per cell, 1 or 0; infinite cells are outside
  double overruled = 0;  // share of the weight of votes on the other side than the vote, 0 without votes
  std::vector<std::uint8_t> contradicted;  // per cell: 1 where the votes in it say the contrary
  std::int64_t mixed_voids = 0;            // voids that were cut
};

/// Poles vote: one that is labelled, bounded and not uncertain says on which side the cell is that it lies
/// in, with the weight of the area around its samples. Cells that hang together through facets outside of the
/// dual complex K are one void and have one label, unless votes of both kinds are in it: then K leaks there,
/// and the void is cut where it is cheapest. A facet costs its area, in K a hundredth of it (so the sheet is
/// the shortest inside a thick K). A void that nothing outside reaches is inside, at half the area of what
/// bounds it, unless poles object. The whole is a minimum cut between inside and outside.
///
/// - `sample`: all samples, of which the balls of the diagram are some; the poles are theirs
/// Throws InputError where the diagram has fewer than three dimensions, and where poles and sample do not
/// fit.
CellLabels cell_labels(const PowerDiagram& diagram, const PoleSet& poles, const PointSet& sample,
                       Monitor& monitor);

/// The area of the facet of a cell opposite corner k, which is finite.
double facet_area(const PowerDiagram& diagram, std::size_t cell, std::size_t k);

}  // namespace ballflow::geometry
