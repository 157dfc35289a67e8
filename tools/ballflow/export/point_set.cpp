// PointSet: its points with their normals, where there are any.
#include "export/format_table.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::PointSet;

PolyData poly_data(const PointSet& set) {
  PolyData data;
  data.points = set.points;
  data.normals = set.normals;
  data.dot_every_point();
  return data;
}

}  // namespace

TypeFormats point_set_formats() {
  return {"PointSet",
          {format<PointSet, poly_data, write_ply>("ply"),
           format<PointSet, poly_data, write_xyz>("xyz"),
           format<PointSet, poly_data, write_csv>("csv"),
           format<PointSet, poly_data, write_off>("off"),
           format<PointSet, poly_data, write_vtp>("vtp"),
           format<PointSet, poly_data, write_npy>("npy"),
           {"glb", write_glb}}};
}

}  // namespace ballflow
