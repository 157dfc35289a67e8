// MedialAxis: its polygons as fans of triangles, the edges that bound none, isolated vertices.
#include <cstdint>

#include "export/typed.hpp"
#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {
namespace {

using geometry::MedialAxis;

std::vector<Layer> layers(const Artifact& artifact) {
  const auto axis = typed<MedialAxis>(artifact);
  std::vector<bool> used(axis.vertices.size(), false);
  const auto use = [&used](std::int32_t v) {
    used[static_cast<std::size_t>(v)] = true;
    return static_cast<std::uint32_t>(v);
  };

  Layer sheets;
  sheets.name = "medial axis";
  sheets.shape = Shape::triangles;
  sheets.vertices = axis.vertices;
  std::vector<std::uint8_t> kinds;
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    const auto corners = axis.polygon(i);
    for (std::size_t k = 2; k < corners.size(); ++k) {
      sheets.triangles.push_back({use(corners[0]), use(corners[k - 1]), use(corners[k])});
      kinds.push_back(axis.polygon_kinds[i]);
    }
  }
  sheets.attributes = {radius_attribute(axis.radii.span()),
                       category_attribute("kind", {"alpha-shape", "Voronoi facet", "wall"}, false, kinds)};
  sheets.colour_by = "radius";

  Layer edges;
  edges.name = "medial axis edges";
  edges.shape = Shape::segments;
  edges.vertices = axis.vertices;
  for (const auto& [a, b] : axis.edges) edges.segments.push_back({use(a), use(b)});
  edges.attributes = {radius_attribute(axis.radii.span())};
  edges.colour_by = "radius";

  std::vector<geometry::Vec3> isolated;
  std::vector<double> radii;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) continue;
    isolated.push_back(axis.vertices[v]);
    radii.push_back(axis.radii[v]);
  }
  Layer points;
  points.name = "medial axis points";
  points.vertices = std::move(isolated);
  points.attributes = {radius_attribute(radii)};
  points.colour_by = "radius";
  return {sheets, edges, points};
}

}  // namespace

TypeLayers medial_axis_layers() { return {"MedialAxis", layers}; }

}  // namespace ballflow::show
