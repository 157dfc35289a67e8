#include "search/neighbor_distances.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include "base/for_each_block.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {

std::vector<double> neighbor_distances(std::span<const Vec3> points, int k, Monitor& monitor) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr std::size_t most = 64;
  const auto wanted = static_cast<std::size_t>(k);
  if (k < 1 || wanted > most) throw std::logic_error("k is from 1 to 64");
  const BoxTree tree(points);
  std::vector<double> result(points.size());
  for_each_block(points.size(), 1024, monitor, 0, 0, [&](std::size_t, std::size_t first, std::size_t last) {
    std::array<double, most> nearest;  // ascending
    for (std::size_t i = first; i < last; ++i) {
      std::fill_n(nearest.begin(), wanted, infinity);
      const Vec3 p = points[i];
      result[i] = tree.smallest(p, infinity, -infinity, [&](std::size_t j) {
        const double d = j == i ? infinity : distance(p, points[j]);
        if (d < nearest[wanted - 1]) {
          std::size_t at = wanted - 1;
          for (; at > 0 && nearest[at - 1] > d; --at) nearest[at] = nearest[at - 1];
          nearest[at] = d;
        }
        return nearest[wanted - 1];
      });
    }
  });
  return result;
}

}  // namespace ballflow::geometry
