#include "refine/foreign_simplices.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "power/alpha_shape.hpp"

namespace ballflow::geometry {

std::vector<std::int32_t> foreign_balls(const Balls& balls, const std::vector<std::array<Vec3, 4>>& samples,
                                        Monitor& monitor) {
  const SimplicialComplex complex = alpha_shape(balls, {AlphaTolerance::polar}, monitor);
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  // A Delaunay ball is empty, so a sample in it is on its sphere; five and more may be.
  const auto passes_through = [&](std::int32_t ball, Vec3 sample) {
    return distance(balls.centers[at(ball)], sample) <= balls.radii[at(ball)] * (1 + 1e-9);
  };
  std::vector<std::uint8_t> foreign(balls.size(), 0);
  const auto look = [&](std::span<const std::int32_t> simplex) {
    const bool common =
        std::any_of(samples[at(simplex[0])].begin(), samples[at(simplex[0])].end(), [&](Vec3 sample) {
          return std::all_of(simplex.begin() + 1, simplex.end(),
                             [&](std::int32_t ball) { return passes_through(ball, sample); });
        });
    if (common) return;
    for (const std::int32_t ball : simplex) foreign[at(ball)] = 1;
  };
  for (const auto& edge : complex.edges) look(edge);
  for (const auto& triangle : complex.triangles) look(triangle);
  std::vector<std::int32_t> result;
  for (std::size_t i = 0; i < foreign.size(); ++i) {
    if (foreign[i] == 1) result.push_back(static_cast<std::int32_t>(i));
  }
  return result;
}

}  // namespace ballflow::geometry
