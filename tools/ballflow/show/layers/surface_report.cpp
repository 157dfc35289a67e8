// SurfaceReport: the surface, coloured by what can be said of its triangles.
#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_surface_report(const Artifact& artifact) {
  const auto report = typed<geometry::SurfaceReport>(artifact);
  Layer layer;
  layer.name = "evidence";
  layer.shape = Shape::triangles;
  layer.vertices = report.vertices;
  std::vector<std::uint8_t> codes;
  for (std::size_t i = 0; i < report.triangles.size(); ++i) {
    const auto& [a, b, c] = report.triangles[i];
    layer.triangles.push_back(
        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
    codes.push_back(geometry::evidence(report, i));
  }
  layer.attributes = {category_attribute(
      "evidence", {"alpha-shape", "closes a gap", "closes a hole", "contradicted"}, false, codes)};
  layer.colour_by = "evidence";
  return {layer};
}

}  // namespace

TypeLayers surface_report_layers() { return {"SurfaceReport", layers_of_surface_report}; }

}  // namespace ballflow::show
