// MedialAxis: ply, obj, off.
#include "export/format_table.hpp"
#include "export/mesh_text.hpp"
#include "export/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::MedialAxis;

void write_ply(const Artifact& artifact, OutputFile& out) {
  const auto axis = typed<MedialAxis>(artifact);
  std::size_t most = 0;
  for (std::size_t i = 0; i < axis.polygons(); ++i) most = std::max(most, axis.polygon(i).size());
  const bool small = most < 256;  // many readers know no other count than uchar
  ply_header(out, {{"vertex", axis.vertices.size(), {"double x", "double y", "double z", "double radius"}},
                   {"face",
                    axis.polygons(),
                    {small ? "list uchar int vertex_indices" : "list int int vertex_indices", "uchar kind"}},
                   {"edge", axis.edges.size(), {"int vertex1", "int vertex2"}}});
  for (std::size_t i = 0; i < axis.vertices.size(); ++i) {
    raw(out, axis.vertices[i]);
    out.raw(axis.radii[i]);
  }
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    const auto corners = axis.polygon(i);
    if (small) {
      out.raw(static_cast<std::uint8_t>(corners.size()));
    } else {
      out.raw(static_cast<std::int32_t>(corners.size()));
    }
    for (const std::int32_t v : corners) out.raw(v);
    out.raw(axis.polygon_kinds[i]);
  }
  for (const auto& edge : axis.edges) {
    for (const std::int32_t v : edge) out.raw(v);
  }
}

void write_obj(const Artifact& artifact, OutputFile& out) {
  const auto axis = typed<MedialAxis>(artifact);
  obj_vertices(out, axis.vertices);
  for (std::size_t i = 0; i < axis.polygons(); ++i) obj_element(out, 'f', axis.polygon(i));
  for (const auto& e : axis.edges) obj_element(out, 'l', e);
}

void write_off(const Artifact& artifact, OutputFile& out) {
  const auto axis = typed<MedialAxis>(artifact);
  off_header(out, axis.vertices, axis.polygons());
  for (std::size_t i = 0; i < axis.polygons(); ++i) off_face(out, axis.polygon(i));
}

}  // namespace

TypeFormats medial_axis_formats() {
  return {"MedialAxis", {{"ply", write_ply}, {"obj", write_obj}, {"off", write_off}}};
}

}  // namespace ballflow
