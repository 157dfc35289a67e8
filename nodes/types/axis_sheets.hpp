// Sheets and seams of a medial axis, and which polygons are to be turned over.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "types/medial_axis.hpp"

namespace ballflow::geometry {

/// What the arrays of these names in MedialAxis must be, for the polygons of the axis in their directions.
struct AxisSheets {
  std::vector<std::int32_t> polygon_sheets;
  std::vector<std::uint8_t> sheet_orientable;
  std::vector<std::array<std::int32_t, 2>> seams;
  std::vector<std::int32_t> seam_degrees;
  std::vector<std::int32_t> seam_curves;
  std::vector<std::uint8_t> turned;  // per polygon, 1 where its direction disagrees with its sheet's
};

/// Time O(k log k) for k corners of polygons.
AxisSheets axis_sheets(const MedialAxis& axis, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
