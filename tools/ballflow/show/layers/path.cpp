// Path: the polyline.
#include "types/path.hpp"

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/motion_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_path(const Artifact& artifact) {
  const auto path = typed<geometry::Path>(artifact);
  Layer layer;
  layer.name = "path";
  layer.vertices = path.points;
  layer.attributes = {radius_attribute(path.radii.span()), order_attribute(path.size())};
  if (path.size() == 1) return {std::move(layer)};  // a point
  layer.shape = Shape::segments;
  for (std::uint32_t i = 1; i < path.size(); ++i) layer.segments.push_back({i - 1, i});
  return {std::move(layer)};
}

}  // namespace

TypeLayers path_layers() { return {"Path", layers_of_path}; }

}  // namespace ballflow::show
