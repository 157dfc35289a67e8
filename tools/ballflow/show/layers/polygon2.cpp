// Polygon2: its rings as segments in the plane z = 0, outer ones and holes told apart.
#include "types/polygon2.hpp"

#include <cstdint>

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/planar_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_polygon(const Artifact& artifact) {
  const auto polygon = typed<geometry::Polygon2>(artifact);
  Layer layer;
  layer.name = "polygon";
  layer.shape = Shape::segments;
  std::vector<geometry::Vec3> vertices;
  for (const geometry::Vec2 p : polygon.vertices) vertices.push_back(geometry::in_space(p));
  layer.vertices = std::move(vertices);
  std::vector<std::uint8_t> kinds;
  for (std::size_t k = 0; k < polygon.components(); ++k) {
    for (std::int64_t r = polygon.component_offsets[k]; r < polygon.component_offsets[k + 1]; ++r) {
      const auto first = static_cast<std::uint32_t>(polygon.ring_offsets[static_cast<std::size_t>(r)]);
      const auto size = static_cast<std::uint32_t>(polygon.ring(static_cast<std::size_t>(r)).size());
      for (std::uint32_t i = 0; i < size; ++i) {
        layer.segments.push_back({first + i, first + (i + 1) % size});
        kinds.push_back(r == polygon.component_offsets[k] ? 0 : 1);
      }
    }
  }
  layer.attributes = {category_attribute("ring", {"outer", "hole"}, false, kinds)};
  layer.colour_by = "ring";
  return {layer};
}

}  // namespace

TypeLayers polygon2_layers() { return {"Polygon2", layers_of_polygon}; }

}  // namespace ballflow::show
