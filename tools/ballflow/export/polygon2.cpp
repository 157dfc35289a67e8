// Polygon2: its rings, in the formats that ReadPolygon reads.
#include "types/polygon2.hpp"

#include "export/format_table.hpp"
#include "types/planar_types.hpp"

namespace ballflow {
namespace {

using geometry::Polygon2;

PolyData poly_data(const Polygon2& polygon) {
  PolyData data;
  std::vector<geometry::Vec3> points;
  for (const geometry::Vec2 p : polygon.vertices) points.push_back(geometry::in_space(p));
  data.points = std::move(points);
  std::vector<Edge> edges;
  for (std::size_t r = 0; r < polygon.rings(); ++r) {
    const auto first = static_cast<std::int32_t>(polygon.ring_offsets[r]);
    const auto size = static_cast<std::int32_t>(polygon.ring(r).size());
    for (std::int32_t i = 0; i < size; ++i) edges.push_back({first + i, first + (i + 1) % size});
  }
  data.edges = std::move(edges);
  return data;
}

void write_polygon(const Artifact& artifact, OutputFile& out, void (*write)(const Polygon2&, OutputFile&)) {
  write(typed<Polygon2>(artifact), out);
}

}  // namespace

TypeFormats polygon2_formats() {
  return {"Polygon2",
          {{"svg", [](const Artifact& a, OutputFile& out) { write_polygon(a, out, write_svg); }},
           {"geojson", [](const Artifact& a, OutputFile& out) { write_polygon(a, out, write_geojson); }},
           {"wkt", [](const Artifact& a, OutputFile& out) { write_polygon(a, out, write_wkt); }},
           {"poly2d", [](const Artifact& a, OutputFile& out) { write_polygon(a, out, write_poly2d); }},
           format<Polygon2, poly_data, write_ply>("ply"),
           format<Polygon2, poly_data, write_obj>("obj"),
           format<Polygon2, poly_data, write_vtp>("vtp"),
           {"glb", write_glb}}};
}

}  // namespace ballflow
