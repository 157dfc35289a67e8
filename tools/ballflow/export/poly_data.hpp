// What the writers of geometry see of an artifact: points, edges and polygons with values, whatever they
// mean.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/array.hpp"
#include "base/vec3.hpp"

namespace ballflow {

using Edge = std::array<std::int32_t, 2>;
using Triangle = std::array<std::int32_t, 3>;

/// One small number per element, and what it is called in files that name such things ("label"); no name
/// where there are none.
struct Codes {
  std::string_view name;
  geometry::Array<std::uint8_t> values;
};

/// One number per point or polygon, with a name as above.
struct Numbers {
  std::string_view name;
  geometry::Array<std::int32_t> values;
};

/// One double per point, with a name.
struct Column {
  std::string_view name;
  std::vector<double> values;
};

struct PolyData {
  geometry::Array<geometry::Vec3> points;  // n x 3, model units

  geometry::Array<geometry::Vec3> normals;       // n x 3 or empty
  std::optional<geometry::Array<double>> radii;  // n
  std::vector<Column> point_columns;             // each n; after the radii in every format
  Codes point_codes;                             // n where it has a name
  Numbers point_numbers;                         // n where it has a name

  // Points that are something by themselves, not only as ends of edges and corners of polygons.
  std::vector<std::int32_t> dots;
  geometry::Array<Edge> edges;  // e x 2 indices of points; those that bound polygons need not be listed
  // Corners of polygon i: polygon_corners[polygon_offsets[i] .. polygon_offsets[i + 1])
  std::vector<std::int64_t> polygon_offsets{0};
  geometry::Array<std::int32_t> polygon_corners;
  Codes polygon_codes;                                       // one per polygon where it has a name
  std::vector<std::array<std::uint8_t, 3>> polygon_colours;  // one per polygon or none: red, green, blue
  std::uint8_t dot_and_edge_code = 0;  // what polygon_codes would say of every dot and edge
  Numbers polygon_numbers;             // one per polygon where it has a name; -1 for every dot and edge

  std::size_t polygons() const { return polygon_offsets.size() - 1; }
  std::span<const std::int32_t> polygon(std::size_t i) const {
    const auto first = static_cast<std::size_t>(polygon_offsets[i]);
    return polygon_corners.span().subspan(first, static_cast<std::size_t>(polygon_offsets[i + 1]) - first);
  }

  void dot_every_point();
  void set_triangles(std::span<const Triangle> triangles);
};

/// The polygons as fans of triangles around their first corners: no new points, and the same surface where
/// polygons are convex and flat, as facets of Voronoi diagrams are.
std::vector<Triangle> triangles_of(const PolyData& data);

/// `data.edges` and all sides of `triangles`, each once with its smaller index first, ascending.
std::vector<Edge> edges_of(const PolyData& data, std::span<const Triangle> triangles);

}  // namespace ballflow
