// Refinement: where walls and slots are too thin for the floor, by their width.
#include "show/layer_table.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_refinement(const Artifact& artifact) {
  const auto report = typed<geometry::Refinement>(artifact);
  Layer places;
  places.name = "thin places";
  places.vertices = report.limited;
  places.attributes = {{"width", "model units", {}, true, {report.widths.begin(), report.widths.end()}}};
  places.colour_by = "width";
  return {std::move(places)};
}

}  // namespace

TypeLayers refinement_layers() { return {"Refinement", layers_of_refinement}; }

}  // namespace ballflow::show
