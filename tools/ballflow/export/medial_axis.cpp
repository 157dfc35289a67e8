// MedialAxis: its polygons, edges and isolated vertices.
#include "export/format_table.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::MedialAxis;

PolyData poly_data(const MedialAxis& axis) {
  PolyData data;
  data.points = axis.vertices;
  data.radii = axis.radii;
  data.edges = axis.edges;
  data.polygon_offsets.assign(axis.polygon_offsets.begin(), axis.polygon_offsets.end());
  data.polygon_corners = axis.polygon_vertices;
  data.polygon_codes = {"kind", axis.polygon_kinds};
  data.polygon_numbers = {"sheet", axis.polygon_sheets};
  data.dot_and_edge_code = static_cast<std::uint8_t>(geometry::AxisKind::singular);
  std::vector<bool> used(axis.vertices.size(), false);
  for (const std::int32_t v : axis.polygon_vertices) used[static_cast<std::size_t>(v)] = true;
  for (const Edge& edge : axis.edges) {
    for (const std::int32_t v : edge) used[static_cast<std::size_t>(v)] = true;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) data.dots.push_back(static_cast<std::int32_t>(v));
  }
  return data;
}

}  // namespace

TypeFormats medial_axis_formats() {
  using Axis = MedialAxis;
  return {"MedialAxis",
          {format<Axis, poly_data, write_ply>("ply"),
           format<Axis, poly_data, write_obj>("obj"),
           format<Axis, poly_data, write_off>("off"),
           format<Axis, poly_data, write_stl>("stl"),
           format<Axis, poly_data, write_vtp>("vtp"),
           {"glb", write_glb},
           format<Axis, poly_data, write_ma>("ma"),
           format<Axis, poly_data, write_csv>("csv"),
           format<Axis, poly_data, write_npy>("npy")}};
}

}  // namespace ballflow
