#include "enclose/union_voids.hpp"

#include <cstdint>
#include <limits>

#include "power/voids.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

std::vector<UnionVoid> union_voids(const PowerDiagram& diagram, const WindingNumber& winding,
                                   Monitor& monitor) {
  const Voids voids(diagram, monitor);
  SimplicialComplex balls;  // what power_vertex looks at
  balls.centers = diagram.centers;
  balls.weights = diagram.weights;
  std::vector<UnionVoid> result;
  for (std::int32_t v = Voids::outer + 1; v < voids.count(); ++v) {
    PowerVertex deepest{{}, -std::numeric_limits<double>::infinity()};
    for (const Voids::Cell& cell : voids.cells_of(v)) {
      const PowerVertex vertex = power_vertex(balls, cell);
      if (vertex.power > deepest.power) deepest = vertex;  // false for what is not finite
    }
    VoidPlace place = VoidPlace::unknown;
    if (winding.chain().closed())
      place = winding.around(deepest.point).number == 0 ? VoidPlace::outside : VoidPlace::inside;
    result.push_back({deepest.point, place});
  }
  return result;
}

}  // namespace ballflow::geometry
