// LocalFeatureSize: the samples, coloured by their distance to the nearest pole.
#include "show/layer_table.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_local_feature_size(const Artifact& artifact) {
  const auto size = typed<geometry::LocalFeatureSize>(artifact);
  Layer layer;
  layer.name = "local feature size";
  layer.vertices = size.points;
  layer.attributes = {
      {"pole distance", "model units", {}, true, {size.pole_distances.begin(), size.pole_distances.end()}}};
  if (!size.axis_distances.empty()) {
    layer.attributes.push_back(
        {"axis distance", "model units", {}, true, {size.axis_distances.begin(), size.axis_distances.end()}});
  }
  layer.colour_by = "pole distance";
  return {layer};
}

}  // namespace

TypeLayers local_feature_size_layers() { return {"LocalFeatureSize", layers_of_local_feature_size}; }

}  // namespace ballflow::show
