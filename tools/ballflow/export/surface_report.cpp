// SurfaceReport: the surface, its triangles with what can be said of each, also as colours.
#include <vector>

#include "export/format_table.hpp"
#include "show/palette.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

using geometry::SurfaceReport;

PolyData poly_data(const SurfaceReport& report) {
  PolyData data;
  data.points = report.vertices;
  data.set_triangles(report.triangles);
  std::vector<std::uint8_t> codes;
  for (std::size_t i = 0; i < report.triangles.size(); ++i) {
    codes.push_back(geometry::evidence(report, i));
    const show::Colour colour = show::category(codes.back());
    data.polygon_colours.push_back({colour.red, colour.green, colour.blue});
  }
  data.polygon_codes = {"evidence", std::move(codes)};
  return data;
}

}  // namespace

TypeFormats surface_report_formats() {
  return {"SurfaceReport",
          {generic_formats().front(),
           format<SurfaceReport, poly_data, write_ply>("ply"),
           format<SurfaceReport, poly_data, write_vtp>("vtp"),
           {"glb", write_glb}}};
}

}  // namespace ballflow
