#include "planar/simplify_polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "planar/read_polygon.hpp"
#include "planar/ring_nesting.hpp"
#include "planar_cases.hpp"

namespace ballflow::geometry {
namespace {

Polygon2 of_rings(std::vector<std::vector<Vec2>> rings) {
  std::vector<RawRing> raw;
  for (auto& points : rings) raw.push_back({std::move(points), RingRole::open, "ring"});
  return nest(std::move(raw)).polygon;
}

/// A closed curve around the origin with a wave and noise.
std::vector<Vec2> coast(int n, double radius, double noise, Random& random) {
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * M_PI * i / n, r = radius * (1 + 0.2 * std::sin(5 * t) + noise * random.unit());
    points.push_back({r * std::cos(t), r * std::sin(t)});
  }
  return points;
}

/// Of points every `step` on the edges of `from`, and of its corners.
double farthest(const Polygon2& from, const Polygon2& to, int parts) {
  double most = 0;
  for (std::size_t r = 0; r < from.rings(); ++r) {
    const auto ring = from.ring(r);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      for (int k = 0; k < parts; ++k)
        most = std::max(most, test::distance_to_boundary(to, a + (1.0 * k / parts) * (b - a)));
    }
  }
  return most;
}

TEST(simplify_polygon, moves_the_boundary_by_no_more_than_the_tolerance) {
  Random random(1);
  for (const double tolerance : {0.01, 0.1, 1.0, 5.0}) {
    for (const double noise : {0.0, 0.001, 0.05}) {
      const Polygon2 polygon =
          of_rings({coast(150, 1, noise, random), coast(100, 0.5, noise, random), coast(30, 0.1, 0, random)});
      const SimplifiedPolygon found = simplify_polygon(polygon, {tolerance});
      EXPECT_FALSE(found.lowered);
      EXPECT_LE(found.polygon.vertices.size(), polygon.vertices.size());
      EXPECT_EQ(found.polygon.rings(), 3u);
      EXPECT_EQ(found.polygon.components(), 2u);
      EXPECT_LE(found.tolerance, tolerance / 100 * bounding_box(polygon).longest_edge());
      EXPECT_LE(farthest(polygon, found.polygon, 4), found.tolerance * (1 + 1e-9) + 1e-15);
      EXPECT_LE(farthest(found.polygon, polygon, 20), found.tolerance * (1 + 1e-9) + 1e-15);
    }
  }
}

TEST(simplify_polygon, keeps_corners_of_the_input_in_their_order) {
  Random random(2);
  const Polygon2 polygon = of_rings({coast(1000, 1, 0.01, random)});
  const SimplifiedPolygon found = simplify_polygon(polygon, {0.3});
  EXPECT_LT(found.polygon.vertices.size(), 400u);
  auto at = polygon.vertices.begin();
  for (const Vec2 p : found.polygon.vertices) {
    at = std::find(at, polygon.vertices.end(), p);
    ASSERT_NE(at, polygon.vertices.end());
  }
}

TEST(simplify_polygon, drops_what_lies_on_straight_edges_and_nothing_else) {
  std::vector<Vec2> outline;
  for (int i = 0; i < 100; ++i) outline.push_back({i / 100.0, 0});
  for (int i = 0; i < 100; ++i) outline.push_back({1, i / 100.0});
  outline.push_back({1, 1});
  outline.push_back({0, 1});
  const SimplifiedPolygon found = simplify_polygon(of_rings({outline}), {1e-6});
  EXPECT_EQ(std::vector<Vec2>(found.polygon.vertices.begin(), found.polygon.vertices.end()),
            (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
}

TEST(simplify_polygon, needs_few_corners_for_a_smooth_curve_with_many) {
  Random random(3);
  const Polygon2 polygon = of_rings({coast(200000, 1, 0, random)});
  const SimplifiedPolygon found = simplify_polygon(polygon);
  // A chord of an arc with the curvature k is sqrt(8 tolerance / k) long; here k is 8 at most.
  EXPECT_LT(found.polygon.vertices.size(), 1200u);
  EXPECT_NEAR(area(found.polygon), area(polygon), found.tolerance * perimeter(polygon));
}

TEST(simplify_polygon, with_tolerance_0_is_the_polygon) {
  const Polygon2 polygon = read_polygon({"polygon:sqroot"}).polygon;
  const SimplifiedPolygon found = simplify_polygon(polygon, {0});
  EXPECT_TRUE(std::equal(found.polygon.vertices.begin(), found.polygon.vertices.end(),
                         polygon.vertices.begin(), polygon.vertices.end()));
  EXPECT_EQ(found.tolerance, 0);
  EXPECT_FALSE(found.lowered);
}

TEST(simplify_polygon, leaves_a_bump_that_holds_an_island) {
  // Without the bump, which is lower than the tolerance, the hole in it would be outside.
  const Polygon2 polygon =
      of_rings({{{0, 0}, {5, -0.01}, {10, 0}, {10, 5}, {6, 5}, {5.5, 5.4}, {4.5, 5.4}, {4, 5}, {0, 5}},
                {{4.9, 5.1}, {5.1, 5.1}, {5, 5.2}}});
  const SimplifiedPolygon found = simplify_polygon(polygon, {5});
  EXPECT_TRUE(found.lowered);
  EXPECT_EQ(found.polygon.rings(), 2u);
  EXPECT_EQ(found.polygon.components(), 1u);
  EXPECT_LE(farthest(polygon, found.polygon, 10), found.tolerance * (1 + 1e-9));
  EXPECT_GT(found.tolerance, 0);
}

TEST(simplify_polygon, keeps_the_walls_of_a_channel_apart) {
  // A comb whose teeth are nearer to each other than the tolerance.
  std::vector<Vec2> comb{{0, 0}, {10, 0}};
  for (int i = 20; i > 0; --i) {
    comb.push_back({i / 2.0, 3 + (i % 3) * 0.3});
    comb.push_back({i / 2.0 - 0.02, 1});
    comb.push_back({i / 2.0 - 0.04, 3 + (i % 2) * 0.3});
  }
  for (const double tolerance : {0.1, 1.0, 10.0, 40.0}) {
    const SimplifiedPolygon found = simplify_polygon(of_rings({comb}), {tolerance});
    EXPECT_EQ(broken_invariant(found.polygon), "");
    std::vector<Vec2> points(found.polygon.vertices.begin(), found.polygon.vertices.end());
    EXPECT_NO_THROW(of_rings({points})) << "rings that cross are refused";
    EXPECT_GE(points.size(), 3u);
  }
}

TEST(simplify_polygon, refuses_what_it_cannot_use) {
  const Polygon2 polygon = read_polygon({"polygon:euro"}).polygon;
  EXPECT_THROW(simplify_polygon({}, {}), InputError);
  EXPECT_THROW(simplify_polygon(polygon, {-1}), InputError);
  EXPECT_THROW(simplify_polygon(polygon, {std::nan("")}), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
