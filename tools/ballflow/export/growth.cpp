// Growth: the grown balls, and what stopped each of them.
#include "export/format_table.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::Growth;

PolyData poly_data(const Growth& growth) {
  PolyData data;
  data.points = growth.centers;
  data.radii = growth.grown_radii;
  data.point_codes = {"stop", growth.stops};
  data.dot_every_point();
  return data;
}

}  // namespace

TypeFormats growth_formats() {
  return {"Growth",
          {format<Growth, poly_data, write_csv>("csv"),
           format<Growth, poly_data, write_ply>("ply"),
           format<Growth, poly_data, write_vtp>("vtp"),
           format<Growth, poly_data, write_npy>("npy"),
           {"glb", write_glb}}};
}

}  // namespace ballflow
