// PointSet: its points.
#include "export/typed.hpp"
#include "show/layer_table.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers(const Artifact& artifact) {
  Layer points;
  points.name = "points";
  points.vertices = typed<geometry::PointSet>(artifact).points;
  return {points};
}

}  // namespace

TypeLayers point_set_layers() { return {"PointSet", layers}; }

}  // namespace ballflow::show
