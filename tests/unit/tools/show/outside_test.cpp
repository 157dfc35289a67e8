#include "show/outside.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ballflow::show {
namespace {

using namespace geometry;

/// The square from (-1, -1) to (1, 1) at z = `z`.
Layer square(double z = 0) {
  Layer layer;
  layer.shape = Shape::triangles;
  layer.vertices = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
  layer.triangles = {{0, 1, 2}, {0, 2, 3}};
  return layer;
}

Layer balls(std::vector<Vec3> centers, std::vector<double> radii) {
  Layer layer;
  layer.shape = Shape::balls;
  layer.vertices = std::move(centers);
  layer.radii = std::move(radii);
  return layer;
}

double area(const Layer& layer) {
  double sum = 0;
  for (const auto& [a, b, c] : layer.triangles) {
    sum += 0.5 * length(cross(layer.vertices[b] - layer.vertices[a], layer.vertices[c] - layer.vertices[a]));
  }
  return sum;
}

TEST(outside, a_disc_is_cut_out_of_a_square) {
  const SplitSurface parts = split_by_balls(square(), balls({{0, 0, 0}}, {0.5}), 0.02);
  EXPECT_EQ(broken_invariant(parts.inside), "");
  EXPECT_EQ(parts.outside.name, "not covered");
  EXPECT_NEAR(area(parts.inside), 3.14159265 * 0.25, 0.01);
  EXPECT_NEAR(area(parts.inside) + area(parts.outside), 4, 1e-12);
  for (const auto& triangle : parts.outside.triangles) {
    Vec3 middle{};
    for (const auto v : triangle) middle = middle + (1.0 / 3) * parts.outside.vertices[v];
    EXPECT_GT(length(middle), 0.5);
  }
}

TEST(outside, what_is_in_one_ball_or_in_none_stays_whole) {
  const SplitSurface inside = split_by_balls(square(), balls({{0, 0, 0}}, {2}), 0.001);
  EXPECT_EQ(inside.inside.elements(), 2u);
  EXPECT_EQ(inside.outside.elements(), 0u);
  const SplitSurface outside = split_by_balls(square(), balls({{0, 0, 9}}, {2}), 0.001);
  EXPECT_EQ(outside.inside.elements(), 0u);
  EXPECT_EQ(outside.outside.elements(), 2u);
  EXPECT_EQ(split_by_balls(square(), balls({}, {}), 0.001).outside.elements(), 2u);
}

TEST(outside, a_link_is_covered_by_its_own_balls_alone) {
  Layer surface = square(), own = balls({{0, 0, 0}, {0, 0, 0}}, {0.25, 2});
  surface.frames = {1, 1, 1, 1};
  own.frames = {1, 0};
  EXPECT_NEAR(area(split_by_balls(surface, own, 0.02).inside), 3.14159265 / 16, 0.01);
  own.frames = {0, 1};
  EXPECT_EQ(split_by_balls(surface, own, 0.02).outside.elements(), 0u);
}

TEST(outside, no_fineness_cuts_for_ever) {
  const SplitSurface parts = split_by_balls(square(), balls({{0, 0, 0}}, {0.5}), 0);
  EXPECT_LT(parts.inside.elements() + parts.outside.elements(), 200000u);
  EXPECT_NEAR(area(parts.inside), 3.14159265 * 0.25, 0.001);
}

}  // namespace
}  // namespace ballflow::show
