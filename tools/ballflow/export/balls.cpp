// Balls: centres and radii.
#include "export/format_table.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::Balls;

PolyData poly_data(const Balls& balls) {
  PolyData data;
  data.points = balls.centers;
  data.radii = balls.radii;
  data.dot_every_point();
  return data;
}

}  // namespace

TypeFormats balls_formats() {
  return {"Balls",
          {format<Balls, poly_data, write_ply>("ply"),
           format<Balls, poly_data, write_csv>("csv"),
           format<Balls, poly_data, write_obj>("obj"),
           format<Balls, poly_data, write_vtp>("vtp"),
           format<Balls, poly_data, write_npy>("npy"),
           {"glb", write_glb},
           format<Balls, poly_data, write_ma>("ma"),
           format<Balls, poly_data, write_sph>("sph"),
           format<Balls, poly_data, write_yaml>("yaml"),
           format<Balls, poly_data, write_urdf>("urdf"),
           format<Balls, poly_data, write_svg>("svg")}};
}

}  // namespace ballflow
