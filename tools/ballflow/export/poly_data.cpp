#include "export/poly_data.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace ballflow {

void PolyData::dot_every_point() {
  dots.resize(points.size());
  std::iota(dots.begin(), dots.end(), 0);
}

void PolyData::set_triangles(std::span<const Triangle> triangles) {
  std::vector<std::int32_t> corners;
  corners.reserve(3 * triangles.size());
  polygon_offsets.assign(1, 0);
  polygon_offsets.reserve(triangles.size() + 1);
  for (const Triangle& t : triangles) {
    corners.insert(corners.end(), t.begin(), t.end());
    polygon_offsets.push_back(static_cast<std::int64_t>(corners.size()));
  }
  polygon_corners = std::move(corners);
}

std::vector<Triangle> triangles_of(const PolyData& data) {
  std::vector<Triangle> triangles;
  triangles.reserve(data.polygon_corners.size());
  for (std::size_t i = 0; i < data.polygons(); ++i) {
    const auto corners = data.polygon(i);
    for (std::size_t k = 2; k < corners.size(); ++k) {
      triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
  }
  return triangles;
}

std::vector<Edge> edges_of(const PolyData& data, std::span<const Triangle> triangles) {
  std::vector<Edge> edges;
  edges.reserve(data.edges.size() + 3 * triangles.size());
  const auto add = [&edges](std::int32_t a, std::int32_t b) {
    edges.push_back({std::min(a, b), std::max(a, b)});
  };
  for (const auto& [a, b] : data.edges) add(a, b);
  for (const auto& [a, b, c] : triangles) {
    add(a, b);
    add(b, c);
    add(c, a);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace ballflow
