// PoleSet: its entries, with radii and labels.
#include "export/format_table.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::PoleSet;

PolyData poly_data(const PoleSet& poles) {
  PolyData data;
  data.points = poles.centers;
  data.radii = poles.radii;
  data.point_codes = {"label", poles.labels};
  data.dot_every_point();
  return data;
}

}  // namespace

TypeFormats pole_set_formats() {
  return {"PoleSet",
          {format<PoleSet, poly_data, write_ply>("ply"),
           format<PoleSet, poly_data, write_csv>("csv"),
           format<PoleSet, poly_data, write_vtp>("vtp"),
           format<PoleSet, poly_data, write_npy>("npy"),
           {"glb", write_glb}}};
}

}  // namespace ballflow
