// MatchedBalls: the balls by how near their partners are, how far they were moved onto them, and the points.
#include "types/matched_balls.hpp"

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/prior_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_matched(const Artifact& artifact) {
  const auto matched = typed<geometry::MatchedBalls>(artifact);
  Layer balls, moves, points;
  balls.name = "matched balls";
  balls.shape = Shape::balls;
  balls.vertices = matched.centers;
  balls.radii = matched.radii;
  std::vector<std::uint8_t> partners;
  for (std::size_t i = 0; i < matched.size(); ++i)
    partners.push_back(static_cast<std::uint8_t>(matched.partners[i] + matched.unique[i]));
  // The order is the template's: balls of one number are the same place on every instance.
  balls.attributes = {
      order_attribute(matched.size()),
      radius_attribute(matched.radii.span()),
      {"residual", "model units", {}, true, {matched.residuals.begin(), matched.residuals.end()}},
      category_attribute("partner", {"none", "shared", "its own"}, true, partners)};
  balls.colour_by = "order";
  moves.name = "from where they were carried";
  moves.shape = Shape::segments;
  std::vector<geometry::Vec3> ends(matched.carried.begin(), matched.carried.end());
  ends.insert(ends.end(), matched.centers.begin(), matched.centers.end());
  moves.vertices = std::move(ends);
  const auto k = static_cast<std::uint32_t>(matched.size());
  for (std::uint32_t i = 0; i < k; ++i) moves.segments.push_back({i, i + k});
  moves.visible = false;
  points.name = "surface points";
  points.vertices = matched.points;
  points.attributes = {order_attribute(matched.points.size()),
                       {"residual",
                        "model units",
                        {},
                        true,
                        {matched.point_residuals.begin(), matched.point_residuals.end()}}};
  points.colour_by = "residual";
  points.visible = false;
  return {std::move(balls), std::move(moves), std::move(points)};
}

}  // namespace

TypeLayers matched_balls_layers() { return {"MatchedBalls", layers_of_matched}; }

}  // namespace ballflow::show
