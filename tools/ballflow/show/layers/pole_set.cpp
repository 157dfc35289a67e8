// PoleSet: its inner poles as points, the outer ones too but hidden at first (some are very far away), and
// both as balls, hidden at first.
#include <string>

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {
namespace {

using geometry::PoleLabel;
using geometry::PoleSet;
using geometry::Vec3;

void add_layers(std::vector<Layer>& layers, const PoleSet& poles, PoleLabel label, const std::string& name) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (poles.labels[i] != static_cast<std::uint8_t>(label)) continue;
    centers.push_back(poles.centers[i]);
    radii.push_back(poles.radii[i]);
  }
  Layer points;
  points.name = name;
  points.vertices = std::move(centers);
  points.attributes = {radius_attribute(radii)};
  points.colour_by = "radius";
  points.visible = label != PoleLabel::outer;
  Layer balls = points;
  balls.name = name + " as balls";
  balls.shape = Shape::balls;
  balls.radii = std::move(radii);
  balls.visible = false;
  layers.push_back(std::move(points));
  layers.push_back(std::move(balls));
}

std::vector<Layer> layers_of_pole_set(const Artifact& artifact) {
  const auto poles = typed<PoleSet>(artifact);
  std::vector<Layer> all;
  add_layers(all, poles, PoleLabel::inner, "inner poles");
  add_layers(all, poles, PoleLabel::outer, "outer poles");
  add_layers(all, poles, PoleLabel::unlabelled, "unlabelled poles");
  return all;
}

}  // namespace

TypeLayers pole_set_layers() { return {"PoleSet", layers_of_pole_set}; }

}  // namespace ballflow::show
