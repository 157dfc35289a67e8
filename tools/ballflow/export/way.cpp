// Way: its points with their clearances as radii, and its segments.
#include "types/way.hpp"

#include "export/format_table.hpp"
#include "types/motion_types.hpp"

namespace ballflow {
namespace {

using geometry::Way;

PolyData poly_data(const Way& way) {
  PolyData data;
  data.points = way.points;
  data.radii = way.clearances;
  std::vector<Edge> edges;
  for (std::int32_t i = 1; i < static_cast<std::int32_t>(way.points.size()); ++i) edges.push_back({i - 1, i});
  data.edges = std::move(edges);
  return data;
}

}  // namespace

TypeFormats way_formats() {
  return {"Way",
          {format<Way, poly_data, write_csv>("csv"), format<Way, poly_data, write_ply>("ply"),
           format<Way, poly_data, write_obj>("obj"), format<Way, poly_data, write_vtp>("vtp"),
           format<Way, poly_data, write_npy>("npy")}};
}

}  // namespace ballflow
