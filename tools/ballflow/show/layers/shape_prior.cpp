// ShapePrior: the balls of the mean, coloured by how much they vary, with a slider for each of the first
// modes, which moves centers and changes radii; its surface points and its mesh, which stay, and what a
// standard deviation of a mode does to the centers, as segments. ShapeFit: the fitted balls, coloured by how
// uncertain they are.
#include "types/shape_prior.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/shape_types.hpp"

namespace ballflow::show {
namespace {

using geometry::ShapePrior;
using geometry::Vec3;

constexpr std::size_t most_sliders = 3, most_frames = 30000;
constexpr double farthest = 3;  // standard deviations

Vec3 displacement(const ShapePrior& prior, std::size_t mode, std::size_t ball) {
  const auto& [x, y, z, growth] = prior.modes[mode * prior.balls() + ball];
  return {x, y, z};
}

/// A slider for each mode; ball i hangs on the last of its frames, which slide one after the other.
std::shared_ptr<const Chain> sliders(const ShapePrior& prior, std::size_t modes) {
  auto chain = std::make_shared<Chain>();
  chain->name = "modes";
  for (std::size_t mode = 0; mode < modes; ++mode)
    chain->joints.push_back({"mode " + std::to_string(mode), "standard deviations", -farthest, farthest, 0});
  for (std::size_t ball = 0; ball < prior.balls(); ++ball) {
    for (std::size_t mode = 0; mode < modes; ++mode) {
      const Vec3 moved = displacement(prior, mode, ball);
      const double way = length(moved);
      Chain::Frame frame;
      frame.name = std::to_string(ball) + "/" + std::to_string(mode);
      frame.parent = mode == 0 ? -1 : static_cast<std::int32_t>(chain->frames.size()) - 1;
      frame.growth = prior.modes[mode * prior.balls() + ball][3];
      if (way > 0 || frame.growth != 0) frame.joint = static_cast<std::int32_t>(mode);
      if (way > 0) {
        frame.motion = Chain::Motion::slide;
        frame.axis = (1 / way) * moved;
        frame.factor = way;
      }
      chain->frames.push_back(std::move(frame));
    }
  }
  return chain;
}

/// From two standard deviations below the mean to two above it.
Layer segments_of_mode(const ShapePrior& prior, std::size_t mode) {
  Layer layer;
  layer.name = "mode " + std::to_string(mode);
  layer.shape = Shape::segments;
  std::vector<Vec3> ends;
  for (std::size_t ball = 0; ball < prior.balls(); ++ball) {
    const Vec3 moved = displacement(prior, mode, ball);
    ends.push_back(prior.centers[ball] - 2.0 * moved);
    ends.push_back(prior.centers[ball] + 2.0 * moved);
    const auto end = static_cast<std::uint32_t>(ends.size());
    layer.segments.push_back({end - 2, end - 1});
  }
  layer.vertices = std::move(ends);
  layer.visible = false;
  return layer;
}

std::vector<Layer> layers_of_shape_prior(const Artifact& artifact) {
  const auto prior = typed<ShapePrior>(artifact);
  const std::size_t modes = std::min(most_sliders, prior.mode_count());
  Layer balls;
  balls.name = "mean";
  balls.shape = Shape::balls;
  balls.vertices = prior.centers;
  balls.radii = prior.radii;
  Attribute varies{"variation", "model units", {}, true, {}}, grows{"variation of radii", "", {}, true, {}};
  for (std::size_t ball = 0; ball < prior.balls(); ++ball) {
    double squares = 0, growths = 0;
    for (std::size_t mode = 0; mode < prior.mode_count(); ++mode) {
      const double growth = prior.modes[mode * prior.balls() + ball][3];
      squares += squared_length(displacement(prior, mode, ball));
      growths += growth * growth;
    }
    varies.values.push_back(std::sqrt(squares));
    grows.values.push_back(std::sqrt(growths));
  }
  balls.attributes = {std::move(varies), std::move(grows), radius_attribute(prior.radii.span())};
  balls.colour_by = "variation";
  // Every ball has a frame for each slider, which a page writes out.
  const std::size_t moving = std::min(modes, most_frames / prior.balls());
  if (moving > 0) {
    balls.chain = sliders(prior, moving);
    for (std::size_t ball = 0; ball < prior.balls(); ++ball)
      balls.frames.push_back(static_cast<std::uint32_t>(ball * moving + moving - 1));
  }
  std::vector<Layer> layers = {std::move(balls)};
  if (!prior.points.empty()) {
    Layer surface;
    surface.name = "mean surface";
    surface.vertices = prior.points;
    surface.visible = false;
    layers.push_back(std::move(surface));
  }
  if (!prior.triangles.empty()) {
    Layer mesh;
    mesh.name = "mean mesh";
    mesh.shape = Shape::triangles;
    mesh.vertices = prior.vertices;
    for (const auto& [a, b, c] : prior.triangles)
      mesh.triangles.push_back(
          {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
    mesh.opacity = 0.3;
    mesh.smooth = true;
    mesh.visible = false;
    layers.push_back(std::move(mesh));
  }
  for (std::size_t mode = 0; mode < modes; ++mode) layers.push_back(segments_of_mode(prior, mode));
  return layers;
}

std::vector<Layer> layers_of_shape_fit(const Artifact& artifact) {
  const auto fit = typed<geometry::ShapeFit>(artifact);
  Layer layer;
  layer.name = "fitted balls";
  layer.shape = Shape::balls;
  layer.vertices = fit.centers;
  layer.radii = fit.radii;
  layer.attributes = {
      Attribute{"uncertainty", "model units", {}, true, {fit.deviations.begin(), fit.deviations.end()}},
      radius_attribute(fit.radii.span())};
  layer.colour_by = "uncertainty";
  return {std::move(layer)};
}

}  // namespace

TypeLayers shape_prior_layers() { return {"ShapePrior", layers_of_shape_prior}; }
TypeLayers shape_fit_layers() { return {"ShapeFit", layers_of_shape_fit}; }

}  // namespace ballflow::show
