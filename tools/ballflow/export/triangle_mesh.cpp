// TriangleMesh: ply, obj, off, stl.
#include <cmath>

#include "export/format_table.hpp"
#include "export/mesh_text.hpp"
#include "export/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::TriangleMesh;
using geometry::Vec3;

void write_ply(const Artifact& artifact, OutputFile& out) {
  const auto mesh = typed<TriangleMesh>(artifact);
  ply_header(out, {{"vertex", mesh.vertices.size(), {"double x", "double y", "double z"}},
                   {"face", mesh.triangles.size(), {"list uchar int vertex_indices"}}});
  for (const Vec3 v : mesh.vertices) raw(out, v);
  for (const geometry::Triangle& t : mesh.triangles) {
    out.raw(std::uint8_t{3});
    for (const std::int32_t v : t) out.raw(v);
  }
}

void write_obj(const Artifact& artifact, OutputFile& out) {
  const auto mesh = typed<TriangleMesh>(artifact);
  obj_vertices(out, mesh.vertices);
  for (const geometry::Triangle& t : mesh.triangles) obj_element(out, 'f', t);
}

void write_off(const Artifact& artifact, OutputFile& out) {
  const auto mesh = typed<TriangleMesh>(artifact);
  off_header(out, mesh.vertices, mesh.triangles.size());
  for (const geometry::Triangle& t : mesh.triangles) off_face(out, t);
}

void raw_float(OutputFile& out, Vec3 p) {
  for (const double value : {p.x, p.y, p.z}) {
    const auto single = static_cast<float>(value);
    if (!std::isfinite(single)) {
      throw Error(ExitCode::usage,
                  "the coordinate " + std::to_string(value) + " does not fit the floats of STL",
                  "write ply, obj or off");
    }
    out.raw(single);
  }
}

/// Unit normal, or zero for a triangle without area.
Vec3 normal(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = geometry::cross(b - a, c - a);
  const double size = geometry::length(n);
  return size > 0 && std::isfinite(size) ? (1 / size) * n : Vec3{};
}

void write_stl(const Artifact& artifact, OutputFile& out) {
  const auto mesh = typed<TriangleMesh>(artifact);
  std::string header = "binary STL written by ballflow";  // must not begin with "solid"
  header.resize(80, ' ');
  out << std::string_view(header);
  out.raw(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const geometry::Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    raw_float(out, normal(corner(0), corner(1), corner(2)));
    for (std::size_t k = 0; k < 3; ++k) raw_float(out, corner(k));
    out.raw(std::uint16_t{0});
  }
}

}  // namespace

TypeFormats triangle_mesh_formats() {
  return {"TriangleMesh", {{"ply", write_ply}, {"obj", write_obj}, {"off", write_off}, {"stl", write_stl}}};
}

}  // namespace ballflow
