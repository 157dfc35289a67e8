// SimplicialComplex: ply, obj, off. Vertices of the complex are numbered anew in their order. Interior
// triangles are left out, as they cannot be seen, and so are sides of triangles.
#include <cmath>

#include "export/format_table.hpp"
#include "export/mesh_text.hpp"
#include "export/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::SimplexClass;
using geometry::SimplicialComplex;
using geometry::Vec3;

struct Drawing {
  std::vector<Vec3> vertices;
  std::vector<double> radii;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::uint8_t> triangle_classes;
  std::vector<std::array<std::int32_t, 2>> edges;
};

Drawing drawing_of(const Artifact& artifact) {
  const auto complex = typed<SimplicialComplex>(artifact);
  Drawing drawing;
  std::vector<std::int32_t> number(complex.centers.size());
  for (const std::int32_t ball : complex.vertices) {
    const auto i = static_cast<std::size_t>(ball);
    number[i] = static_cast<std::int32_t>(drawing.vertices.size());
    drawing.vertices.push_back(complex.centers[i]);
    drawing.radii.push_back(std::sqrt(complex.weights[i]));
  }
  const auto renumbered = [&](auto simplex) {
    for (std::int32_t& v : simplex) v = number[static_cast<std::size_t>(v)];
    return simplex;
  };
  for (std::size_t i = 0; i < complex.triangles.size(); ++i) {
    if (complex.triangle_classes[i] == static_cast<std::uint8_t>(SimplexClass::interior)) continue;
    drawing.triangles.push_back(renumbered(complex.triangles[i]));
    drawing.triangle_classes.push_back(complex.triangle_classes[i]);
  }
  for (std::size_t i = 0; i < complex.edges.size(); ++i) {
    if (complex.edge_classes[i] != static_cast<std::uint8_t>(SimplexClass::singular)) continue;
    drawing.edges.push_back(renumbered(complex.edges[i]));
  }
  return drawing;
}

void write_ply(const Artifact& artifact, OutputFile& out) {
  const Drawing d = drawing_of(artifact);
  ply_header(out, {{"vertex", d.vertices.size(), {"double x", "double y", "double z", "double radius"}},
                   {"face", d.triangles.size(), {"list uchar int vertex_indices", "uchar class"}},
                   {"edge", d.edges.size(), {"int vertex1", "int vertex2"}}});
  for (std::size_t i = 0; i < d.vertices.size(); ++i) {
    raw(out, d.vertices[i]);
    out.raw(d.radii[i]);
  }
  for (std::size_t i = 0; i < d.triangles.size(); ++i) {
    out.raw(std::uint8_t{3});
    for (const std::int32_t v : d.triangles[i]) out.raw(v);
    out.raw(d.triangle_classes[i]);
  }
  for (const auto& edge : d.edges) {
    for (const std::int32_t v : edge) out.raw(v);
  }
}

void write_obj(const Artifact& artifact, OutputFile& out) {
  const Drawing d = drawing_of(artifact);
  obj_vertices(out, d.vertices);
  for (const auto& t : d.triangles) obj_element(out, 'f', t);
  for (const auto& e : d.edges) obj_element(out, 'l', e);
}

void write_off(const Artifact& artifact, OutputFile& out) {
  const Drawing d = drawing_of(artifact);
  off_header(out, d.vertices, d.triangles.size());
  for (const auto& t : d.triangles) off_face(out, t);
}

}  // namespace

TypeFormats simplicial_complex_formats() {
  return {"SimplicialComplex", {{"ply", write_ply}, {"obj", write_obj}, {"off", write_off}}};
}

}  // namespace ballflow
