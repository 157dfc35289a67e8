// PointSet: its points.
#include "show/layer_table.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {

Layer layer_of(const geometry::PointSet& points) {
  Layer layer;
  layer.name = "points";
  layer.vertices = points.points;
  return layer;
}

TypeLayers point_set_layers() {
  return {"PointSet", [](const Artifact& artifact) {
            return std::vector{layer_of(typed<geometry::PointSet>(artifact))};
          }};
}

}  // namespace ballflow::show
