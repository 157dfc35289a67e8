// LocalFeatureSize: the samples, with D^ where other types have a radius.
#include "export/format_table.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::LocalFeatureSize;

PolyData poly_data(const LocalFeatureSize& size) {
  PolyData data;
  data.points = size.points;
  data.radii = size.pole_distances;
  data.dot_every_point();
  return data;
}

}  // namespace

TypeFormats local_feature_size_formats() {
  return {"LocalFeatureSize",
          {format<LocalFeatureSize, poly_data, write_csv>("csv"),
           format<LocalFeatureSize, poly_data, write_ply>("ply"),
           format<LocalFeatureSize, poly_data, write_vtp>("vtp"),
           format<LocalFeatureSize, poly_data, write_npy>("npy"),
           {"glb", write_glb}}};
}

}  // namespace ballflow
