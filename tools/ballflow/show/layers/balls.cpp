// Balls: all of them, with their radii and their order.
#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_balls(const Artifact& artifact) {
  const auto balls = typed<geometry::Balls>(artifact);
  Layer layer;
  layer.name = "balls";
  layer.shape = Shape::balls;
  layer.vertices = balls.centers;
  layer.radii = balls.radii;
  layer.attributes = {radius_attribute(balls.radii.span()), order_attribute(balls.size())};
  layer.colour_by = "radius";
  return {layer};
}

}  // namespace

TypeLayers balls_layers() { return {"Balls", layers_of_balls}; }

}  // namespace ballflow::show
