// Enclosure: where balls leave a surface, or its inside, out.
#include "show/layer_table.hpp"
#include "show/typed.hpp"
#include "types/enclosure_type.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_enclosure(const Artifact& artifact) {
  const auto found = typed<geometry::Enclosure>(artifact);
  Layer open, voids;
  open.name = "not covered";
  open.vertices = found.open_points;
  voids.name = "voids";
  voids.vertices = found.void_points;
  return {std::move(open), std::move(voids)};
}

}  // namespace

TypeLayers enclosure_layers() { return {"Enclosure", layers_of_enclosure}; }

}  // namespace ballflow::show
