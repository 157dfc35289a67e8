// TriangleMesh: its vertices and triangles.
#include "export/format_table.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::TriangleMesh;

PolyData poly_data(const TriangleMesh& mesh) {
  PolyData data;
  data.points = mesh.vertices;
  data.set_triangles(mesh.triangles);
  return data;
}

}  // namespace

TypeFormats triangle_mesh_formats() {
  using Mesh = TriangleMesh;
  return {"TriangleMesh",
          {format<Mesh, poly_data, write_ply>("ply"),
           format<Mesh, poly_data, write_obj>("obj"),
           format<Mesh, poly_data, write_off>("off"),
           format<Mesh, poly_data, write_stl>("stl"),
           format<Mesh, poly_data, write_vtp>("vtp"),
           {"glb", write_glb}}};
}

}  // namespace ballflow
