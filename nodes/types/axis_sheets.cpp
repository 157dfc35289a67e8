#include "types/axis_sheets.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>

#include "base/index.hpp"
#include "types/polygon_edges.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Two polygons at an edge that no other polygon has.
struct Link {
  std::int32_t first, second;
  bool agree;  // they run through the edge in opposite directions
};

// Numbers the polygons by sheets, and finds which ones face the wrong way.
void label_polygons(std::size_t polygons, const std::vector<Link>& links, AxisSheets& out, Lookout& look) {
  std::vector<std::size_t> begin(polygons + 1, 0);
  for (const Link& link : links) {
    ++begin[at(link.first) + 1];
    ++begin[at(link.second) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  index_of(links.size(), "pairs of polygons with a common edge");
  std::vector<std::int32_t> around(begin.back());  // links of each polygon
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < links.size(); ++i) {
    around[next[at(links[i].first)]++] = static_cast<std::int32_t>(i);
    around[next[at(links[i].second)]++] = static_cast<std::int32_t>(i);
  }
  out.polygon_sheets.assign(polygons, -1);
  out.turned.assign(polygons, 0);
  std::vector<std::int32_t> queue;
  for (std::size_t seed = 0; seed < polygons; ++seed) {
    if (out.polygon_sheets[seed] >= 0) continue;
    const auto sheet = static_cast<std::int32_t>(out.sheet_orientable.size());
    out.sheet_orientable.push_back(1);
    out.polygon_sheets[seed] = sheet;
    queue.assign(1, static_cast<std::int32_t>(seed));
    for (std::size_t head = 0; head < queue.size(); ++head) {
      look(32);
      const std::int32_t polygon = queue[head];
      for (std::size_t k = begin[at(polygon)]; k < begin[at(polygon) + 1]; ++k) {
        const Link& link = links[at(around[k])];
        const std::int32_t other = link.first == polygon ? link.second : link.first;
        const auto wanted = static_cast<std::uint8_t>(link.agree ? out.turned[at(polygon)] != 0
                                                                 : out.turned[at(polygon)] == 0);
        if (out.polygon_sheets[at(other)] < 0) {
          out.polygon_sheets[at(other)] = sheet;
          out.turned[at(other)] = wanted;
          queue.push_back(other);
        } else if (out.turned[at(other)] != wanted) {
          out.sheet_orientable[at(sheet)] = 0;
        }
      }
    }
  }
}

// Numbers the seams by curves.
void label_seams(std::size_t vertices, AxisSheets& out) {
  // The first two seams of every vertex, and how many it has.
  struct End {
    std::int32_t count = 0;
    std::array<std::int32_t, 2> seams{-1, -1};
  };
  std::vector<End> ends(vertices);
  for (std::size_t i = 0; i < out.seams.size(); ++i) {
    for (const std::int32_t v : out.seams[i]) {
      End& end = ends[at(v)];
      if (end.count < 2) end.seams[at(end.count)] = static_cast<std::int32_t>(i);
      ++end.count;
    }
  }
  out.seam_curves.assign(out.seams.size(), -1);
  std::int32_t curves = 0;
  std::vector<std::int32_t> queue;
  for (std::size_t seed = 0; seed < out.seams.size(); ++seed) {
    if (out.seam_curves[seed] >= 0) continue;
    out.seam_curves[seed] = curves;
    queue.assign(1, static_cast<std::int32_t>(seed));
    for (std::size_t head = 0; head < queue.size(); ++head) {
      for (const std::int32_t v : out.seams[at(queue[head])]) {
        if (ends[at(v)].count != 2) continue;
        for (const std::int32_t other : ends[at(v)].seams) {
          if (out.seam_curves[at(other)] >= 0) continue;
          out.seam_curves[at(other)] = curves;
          queue.push_back(other);
        }
      }
    }
    ++curves;
  }
}

}  // namespace

AxisSheets axis_sheets(const MedialAxis& axis, Monitor& monitor) {
  AxisSheets out;
  std::vector<Link> links;
  for_each_polygon_edge(
      axis, monitor, [&](const std::array<std::int32_t, 2>& edge, std::span<const PolygonSide> sides) {
        if (sides.size() == 2) {
          links.push_back({sides[0].polygon, sides[1].polygon, sides[0].forward != sides[1].forward});
        } else if (sides.size() > 2) {
          out.seams.push_back(edge);
          out.seam_degrees.push_back(static_cast<std::int32_t>(sides.size()));
        }
      });
  Lookout look(monitor);
  label_polygons(axis.polygons(), links, out, look);
  label_seams(axis.vertices.size(), out);
  return out;
}

}  // namespace ballflow::geometry
