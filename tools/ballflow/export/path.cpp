// Path: its points with their radii, as PathBalls reads them, and its segments.
#include "types/path.hpp"

#include "export/format_table.hpp"
#include "types/motion_types.hpp"

namespace ballflow {
namespace {

using geometry::Path;

PolyData poly_data(const Path& path) {
  PolyData data;
  data.points = path.points;
  data.radii = path.radii;
  std::vector<Edge> edges;
  for (std::int32_t i = 1; i < static_cast<std::int32_t>(path.size()); ++i) edges.push_back({i - 1, i});
  if (edges.empty()) data.dot_every_point();
  data.edges = std::move(edges);
  return data;
}

}  // namespace

TypeFormats path_formats() {
  return {"Path",
          {format<Path, poly_data, write_csv>("csv"), format<Path, poly_data, write_ply>("ply"),
           format<Path, poly_data, write_obj>("obj"), format<Path, poly_data, write_vtp>("vtp"),
           format<Path, poly_data, write_npy>("npy")}};
}

}  // namespace ballflow
