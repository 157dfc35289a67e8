// SampleAssignment: the samples in colours by vertex, or by ball where there is no surface. Numbers of
// neighbours are mixed well, so that two cells that touch seldom have one colour.
#include <cstdint>
#include <string>

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/surface_types.hpp"

namespace ballflow::show {
namespace {

constexpr std::uint32_t colours = 8;

std::vector<Layer> layers_of_sample_assignment(const Artifact& artifact) {
  const auto assignment = typed<geometry::SampleAssignment>(artifact);
  Layer layer;
  layer.name = "samples by vertex";
  layer.vertices = assignment.points;
  const auto& owners = assignment.vertices.empty() ? assignment.balls : assignment.vertices;
  std::vector<std::uint8_t> group;
  std::vector<std::string> names;
  for (std::uint32_t k = 0; k < colours; ++k) names.push_back("group " + std::to_string(k + 1));
  Attribute number{assignment.vertices.empty() ? "ball" : "vertex", "", {}, true, {}};
  for (const std::int32_t owner : owners) {
    number.values.push_back(owner);
    const std::uint32_t mixed = static_cast<std::uint32_t>(owner) * 2654435761u;  // Knuth's
    group.push_back(static_cast<std::uint8_t>(mixed >> 29));
  }
  layer.attributes = {category_attribute("group", names, true, group), number};
  layer.colour_by = "group";
  return {layer};
}

}  // namespace

TypeLayers sample_assignment_layers() { return {"SampleAssignment", layers_of_sample_assignment}; }

}  // namespace ballflow::show
