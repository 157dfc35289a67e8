// Balls: ply, csv, obj.
#include "export/format_table.hpp"
#include "export/mesh_text.hpp"
#include "export/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::Balls;

void write_ply(const Artifact& artifact, OutputFile& out) {
  const auto balls = typed<Balls>(artifact);
  ply_header(out, {{"vertex", balls.size(), {"double x", "double y", "double z", "double radius"}}});
  for (std::size_t i = 0; i < balls.size(); ++i) {
    raw(out, balls.centers[i]);
    out.raw(balls.radii[i]);
  }
}

void write_csv(const Artifact& artifact, OutputFile& out) {
  const auto balls = typed<Balls>(artifact);
  out << "x,y,z,r\n";
  for (std::size_t i = 0; i < balls.size(); ++i) {
    text(out, balls.centers[i], ',');
    out << ',' << balls.radii[i] << '\n';
  }
}

void write_obj(const Artifact& artifact, OutputFile& out) {
  const auto balls = typed<Balls>(artifact);
  out << "# centers of balls; their radii are in ply and csv exports\n";
  obj_vertices(out, balls.centers);
}

}  // namespace

TypeFormats balls_formats() {
  return {"Balls", {{"ply", write_ply}, {"csv", write_csv}, {"obj", write_obj}}};
}

}  // namespace ballflow
