// BallDistance: the balls by their clearance, the nearest pair, and the pairs below the threshold.
#include "show/layer_table.hpp"
#include "show/typed.hpp"
#include "types/motion_types.hpp"

namespace ballflow::show {
namespace {

Attribute length_attribute(const char* name, std::span<const double> values, bool per_vertex) {
  return {name, "model units", {}, per_vertex, {values.begin(), values.end()}};
}

Layer clearances(const char* name, const geometry::Array<geometry::Vec3>& centers,
                 const geometry::Array<double>& radii, std::span<const double> separations) {
  Layer layer;
  layer.name = name;
  layer.shape = Shape::balls;
  layer.vertices = centers;
  layer.radii = radii;
  layer.attributes = {length_attribute("clearance", separations, true)};
  layer.colour_by = "clearance";
  return layer;
}

std::vector<Layer> layers_of_distance(const Artifact& artifact) {
  const auto found = typed<geometry::BallDistance>(artifact);
  Layer nearest;
  nearest.name = "nearest points";
  nearest.shape = Shape::segments;
  nearest.vertices = {found.point_a, found.point_b};
  nearest.segments = {{0, 1}};

  Layer pairs;
  pairs.name = "pairs below the threshold";
  pairs.shape = Shape::segments;
  pairs.visible = false;
  std::vector<geometry::Vec3> ends;
  for (std::size_t i = 0; i < found.pairs.size(); ++i) {
    ends.push_back(found.pair_points_a[i]);
    ends.push_back(found.pair_points_b[i]);
    const auto first = static_cast<std::uint32_t>(2 * i);
    pairs.segments.push_back({first, first + 1});
  }
  pairs.vertices = std::move(ends);
  pairs.attributes = {length_attribute("separation", found.separations.span(), false)};
  pairs.colour_by = "separation";
  return {clearances("clearance of a", found.centers_a, found.radii_a, found.clearances_a.span()),
          clearances("clearance of b", found.centers_b, found.radii_b, found.clearances_b.span()),
          std::move(nearest), std::move(pairs)};
}

}  // namespace

TypeLayers ball_distance_layers() { return {"BallDistance", layers_of_distance}; }

}  // namespace ballflow::show
