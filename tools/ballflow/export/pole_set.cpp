// PoleSet: ply, csv.
#include "export/format_table.hpp"
#include "export/mesh_text.hpp"
#include "export/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::PoleSet;

void write_ply(const Artifact& artifact, OutputFile& out) {
  const auto poles = typed<PoleSet>(artifact);
  ply_header(
      out, {{"vertex", poles.size(), {"double x", "double y", "double z", "double radius", "uchar label"}}});
  for (std::size_t i = 0; i < poles.size(); ++i) {
    raw(out, poles.centers[i]);
    out.raw(poles.radii[i]);
    out.raw(poles.labels[i]);
  }
}

void write_csv(const Artifact& artifact, OutputFile& out) {
  const auto poles = typed<PoleSet>(artifact);
  out << "x,y,z,r,label\n";
  for (std::size_t i = 0; i < poles.size(); ++i) {
    text(out, poles.centers[i], ',');
    out << ',' << poles.radii[i] << ',' << int{poles.labels[i]} << '\n';
  }
}

}  // namespace

TypeFormats pole_set_formats() { return {"PoleSet", {{"ply", write_ply}, {"csv", write_csv}}}; }

}  // namespace ballflow
