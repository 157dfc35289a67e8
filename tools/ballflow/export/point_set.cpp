// PointSet: ply, xyz, csv, off.
#include "export/format_table.hpp"
#include "export/mesh_text.hpp"
#include "export/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::PointSet;

void write_ply(const Artifact& artifact, OutputFile& out) {
  const auto set = typed<PointSet>(artifact);
  PlyElement vertex{"vertex", set.points.size(), {"double x", "double y", "double z"}};
  const bool normals = !set.normals.empty();
  if (normals) vertex.properties.insert(vertex.properties.end(), {"double nx", "double ny", "double nz"});
  ply_header(out, {vertex});
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    raw(out, set.points[i]);
    if (normals) raw(out, set.normals[i]);
  }
}

void write_rows(const PointSet& set, OutputFile& out, char separator) {
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    text(out, set.points[i], separator);
    if (!set.normals.empty()) {
      out << separator;
      text(out, set.normals[i], separator);
    }
    out << '\n';
  }
}

void write_xyz(const Artifact& artifact, OutputFile& out) { write_rows(typed<PointSet>(artifact), out, ' '); }

void write_csv(const Artifact& artifact, OutputFile& out) {
  const auto set = typed<PointSet>(artifact);
  out << (set.normals.empty() ? "x,y,z\n" : "x,y,z,nx,ny,nz\n");
  write_rows(set, out, ',');
}

void write_off(const Artifact& artifact, OutputFile& out) {
  off_header(out, typed<PointSet>(artifact).points, 0);
}

}  // namespace

TypeFormats point_set_formats() {
  return {"PointSet", {{"ply", write_ply}, {"xyz", write_xyz}, {"csv", write_csv}, {"off", write_off}}};
}

}  // namespace ballflow
