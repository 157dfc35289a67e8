// Growth: the grown balls, coloured by what stopped them, or by how much they have grown.
#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_growth(const Artifact& artifact) {
  const auto growth = typed<geometry::Growth>(artifact);
  Layer layer;
  layer.name = "grown balls";
  layer.shape = Shape::balls;
  layer.vertices = growth.centers;
  layer.radii = growth.grown_radii;
  Attribute grown{"growth", "model units", {}, true, {}};
  for (std::size_t i = 0; i < growth.radii.size(); ++i)
    grown.values.push_back(growth.grown_radii[i] - growth.radii[i]);
  layer.attributes = {
      category_attribute("stopped by", {"wish", "pole bound", "critical Gabriel point", "neighbour"}, true,
                         growth.stops.span()),
      std::move(grown), radius_attribute(growth.grown_radii.span())};
  layer.colour_by = "stopped by";
  return {layer};
}

}  // namespace

TypeLayers growth_layers() { return {"Growth", layers_of_growth}; }

}  // namespace ballflow::show
