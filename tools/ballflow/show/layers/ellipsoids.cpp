// Ellipsoids: their surfaces as triangles, and, hidden at first, where their centers are.
#include "show/icosphere.hpp"
#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/layers/ellipsoid_attribute.hpp"
#include "show/typed.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow::show {
namespace {

/// How finely each is drawn: a page has about a million triangles at most.
int rounds_for(std::size_t ellipsoids) { return ellipsoids <= 500 ? 3 : ellipsoids <= 3000 ? 2 : 1; }
constexpr std::size_t most_surfaces = 20000;

Layer surfaces_of(const geometry::Ellipsoids& all) {
  const Icosphere sphere = icosphere(rounds_for(all.size()));
  Attribute shortest = shortest_axis_attribute(all), order = order_attribute(0);
  shortest.per_vertex = order.per_vertex = false;
  const std::vector<double> thickness = std::move(shortest.values);
  shortest.values.clear();
  std::vector<geometry::Vec3> vertices;
  Layer layer;
  vertices.reserve(all.size() * sphere.vertices.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const geometry::Frame frame = geometry::frame_of(all.rotations[i]);
    const geometry::Vec3 r = all.radii[i];
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const geometry::Vec3 u : sphere.vertices)
      vertices.push_back(all.centers[i] + frame.out_of({r.x * u.x, r.y * u.y, r.z * u.z}));
    for (const auto& t : sphere.triangles) {
      layer.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      shortest.values.push_back(thickness[i]);
      order.values.push_back(static_cast<double>(i));
    }
  }
  layer.name = "ellipsoids";
  layer.shape = Shape::triangles;
  layer.vertices = std::move(vertices);
  layer.attributes = {std::move(shortest), std::move(order)};
  layer.colour_by = layer.attributes.front().name;
  layer.smooth = true;
  return layer;
}

std::vector<Layer> layers_of_ellipsoids(const Artifact& artifact) {
  const auto all = typed<geometry::Ellipsoids>(artifact);
  Layer centers;
  centers.name = "centers";
  centers.vertices = all.centers;
  centers.attributes = {shortest_axis_attribute(all), order_attribute(all.size())};
  centers.colour_by = centers.attributes.front().name;
  if (all.size() > most_surfaces) return {std::move(centers)};
  centers.visible = false;
  return {surfaces_of(all), std::move(centers)};
}

}  // namespace

TypeLayers ellipsoids_layers() { return {"Ellipsoids", layers_of_ellipsoids}; }

}  // namespace ballflow::show
