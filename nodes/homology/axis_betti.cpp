#include "homology/axis_betti.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "homology/binary_system.hpp"
#include "types/polygon_edges.hpp"

namespace ballflow::geometry {

Betti axis_betti(const MedialAxis& axis, Monitor& monitor) {
  // A cycle is a set of polygons of which an even number meets at every side.
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> terms;
  terms.reserve(axis.polygon_vertices.size());
  for_each_polygon_edge(axis, monitor,
                        [&](const std::array<std::int32_t, 2>&, std::span<const PolygonSide> sides) {
                          for (const PolygonSide& side : sides) terms.push_back(side.polygon);
                          offsets.push_back(static_cast<std::int64_t>(terms.size()));
                        });
  const BinarySystem cycles(axis.polygons(), offsets, terms, {}, monitor);

  const AxisTopology cells = axis_topology(axis);
  const auto cavities = static_cast<std::int64_t>(cycles.dimension());
  return {cells.components, cells.components + cavities - cells.euler_characteristic, cavities};
}

}  // namespace ballflow::geometry
