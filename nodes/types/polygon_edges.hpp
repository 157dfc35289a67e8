// The edges of the polygons of a medial axis, each with the polygons around it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "types/medial_axis.hpp"

namespace ballflow::geometry {

/// A side of a polygon, filed under the smaller one of its two vertices.
struct PolygonSide {
  std::int32_t larger;  // vertex
  std::int32_t polygon;
  bool forward;  // the polygon runs from the smaller vertex to the larger one

  friend bool operator<(const PolygonSide& a, const PolygonSide& b) {
    return a.larger != b.larger ? a.larger < b.larger : a.polygon < b.polygon;
  }
};

/// Calls visit(edge, sides) for every edge, ascending: a std::array of its vertices, the smaller first, and a
/// span of PolygonSide, by polygon. Corners must be vertices of the axis. Time O(k log k) for k corners.
template <class Visit>
void for_each_polygon_edge(const MedialAxis& axis, Monitor& monitor, const Visit& visit) {
  Lookout look(monitor);
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  const auto for_each_side = [&](const auto& put) {
    for (std::size_t i = 0; i < axis.polygons(); ++i) {
      look(16);
      const auto corners = axis.polygon(i);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::int32_t a = corners[k], b = corners[k + 1 < corners.size() ? k + 1 : 0];
        put(std::min(a, b), PolygonSide{std::max(a, b), static_cast<std::int32_t>(i), a < b});
      }
    }
  };
  std::vector<std::size_t> begin(axis.vertices.size() + 1, 0);
  for_each_side([&](std::int32_t smaller, const PolygonSide&) { ++begin[at(smaller) + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<PolygonSide> sides(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for_each_side([&](std::int32_t smaller, const PolygonSide& side) { sides[next[at(smaller)]++] = side; });
  for (std::size_t v = 0; v < axis.vertices.size(); ++v) {
    look(16);
    const std::span<PolygonSide> own(sides.data() + begin[v], sides.data() + begin[v + 1]);
    std::sort(own.begin(), own.end());
    for (std::size_t first = 0; first < own.size();) {
      std::size_t last = first;
      while (last < own.size() && own[last].larger == own[first].larger) ++last;
      visit(std::array{static_cast<std::int32_t>(v), own[first].larger},
            std::span<const PolygonSide>(own).subspan(first, last - first));
      first = last;
    }
  }
}

}  // namespace ballflow::geometry
