// DiscOutline: its arcs as chains of short segments in the plane z = 0, outer rings and holes told apart.
#include "types/disc_outline.hpp"

#include <cstdint>

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/planar_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_outline(const Artifact& artifact) {
  const auto outline = typed<geometry::DiscOutline>(artifact);
  Layer layer;
  layer.name = "outline";
  layer.shape = Shape::segments;
  std::vector<geometry::Vec3> vertices;
  std::vector<std::uint8_t> kinds;
  // A thousandth of the picture is hardly seen.
  const double error = 1e-4 * bounding_box(outline).longest_edge();
  for (std::size_t k = 0; k < outline.components(); ++k) {
    for (std::int64_t r = outline.component_offsets[k]; r < outline.component_offsets[k + 1]; ++r) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      for (const geometry::Vec2 p : points_on_ring(outline, static_cast<std::size_t>(r), error))
        vertices.push_back(geometry::in_space(p));
      const std::uint32_t size = static_cast<std::uint32_t>(vertices.size()) - first;
      for (std::uint32_t i = 0; i < size; ++i) {
        layer.segments.push_back({first + i, first + (i + 1) % size});
        kinds.push_back(r == outline.component_offsets[k] ? 0 : 1);
      }
    }
  }
  layer.vertices = std::move(vertices);
  layer.attributes = {category_attribute("ring", {"outer", "hole"}, false, kinds)};
  layer.colour_by = "ring";
  return {layer};
}

}  // namespace

TypeLayers disc_outline_layers() { return {"DiscOutline", layers_of_outline}; }

}  // namespace ballflow::show
