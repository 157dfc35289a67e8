#include "look/widths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace ballflow::geometry {
namespace {

void add_box(std::vector<Vec3>& vertices, std::vector<Triangle>& triangles, Vec3 lower, Vec3 upper,
             bool inwards = false) {
  const auto first = static_cast<std::int32_t>(vertices.size());
  for (int i = 0; i < 8; ++i)
    vertices.push_back({i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
  for (const auto& [a, b, c] : std::vector<Triangle>{{0, 2, 1},
                                                     {1, 2, 3},
                                                     {4, 5, 6},
                                                     {5, 7, 6},
                                                     {0, 1, 4},
                                                     {1, 5, 4},
                                                     {2, 6, 3},
                                                     {3, 6, 7},
                                                     {0, 4, 2},
                                                     {2, 4, 6},
                                                     {1, 3, 5},
                                                     {3, 7, 5}})
    triangles.push_back(inwards ? Triangle{first + a, first + c, first + b}
                                : Triangle{first + a, first + b, first + c});
}

TEST(widths, of_a_box_are_its_shortest_edge_and_no_slot) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  add_box(vertices, triangles, {1, 2, 3}, {11, 22, 3.25});
  const Widths widths = widths_of({vertices, triangles});
  ASSERT_TRUE(widths.wall);
  EXPECT_DOUBLE_EQ(widths.wall->width, 0.25);
  EXPECT_NEAR(std::abs(widths.wall->from.z - widths.wall->to.z), 0.25, 1e-12);
  EXPECT_FALSE(widths.slot);
  EXPECT_EQ(widths.places, 12);
  EXPECT_EQ(widths.thin_walls, 8) << "10 and 0.25 are below the diagonals of the faces, 20 is not";
  EXPECT_TRUE(widths.walls.empty()) << "nobody asked";
}

TEST(widths, of_random_boxes_do_not_depend_on_where_searches_end) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> place(0, 100), size(0.1, 6);
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (int i = 0; i < 300; ++i) {
    const Vec3 lower{place(random), place(random), place(random)};
    add_box(vertices, triangles, lower, lower + Vec3{size(random), size(random), size(random)});
  }
  WidthsOptions all;
  all.list_walls = true;
  const Widths a = widths_of({vertices, triangles}), b = widths_of({vertices, triangles}, all);
  ASSERT_TRUE(a.wall && a.slot && b.wall && b.slot);
  EXPECT_EQ(a.wall->triangle, b.wall->triangle);
  EXPECT_EQ(a.slot->width, b.slot->width);
  EXPECT_EQ(a.thin_walls, b.thin_walls);
  EXPECT_EQ(a.narrow_slots, b.narrow_slots);
}

TEST(widths, between_two_boxes_is_a_slot) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  add_box(vertices, triangles, {0, 0, 0}, {4, 4, 4});
  add_box(vertices, triangles, {0, 0, 4.5}, {4, 4, 9});
  const Widths widths = widths_of({vertices, triangles});
  ASSERT_TRUE(widths.slot);
  EXPECT_DOUBLE_EQ(widths.slot->width, 0.5);
  EXPECT_DOUBLE_EQ(widths.wall->width, 4);
  EXPECT_EQ(widths.narrow_slots, 4);
}

TEST(widths, of_a_hollow_box_are_its_walls_and_its_cavity) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  add_box(vertices, triangles, {0, 0, 0}, {10, 10, 10});
  add_box(vertices, triangles, {1, 1, 1}, {9, 9, 9.5}, true);
  const Widths widths = widths_of({vertices, triangles});
  EXPECT_DOUBLE_EQ(widths.wall->width, 0.5);
  EXPECT_DOUBLE_EQ(widths.slot->width, 8);
}

TEST(widths, of_a_torus_are_those_of_its_tube_and_its_hole) {
  const std::int32_t n = 200, m = 100;
  const double tube = 0.4;
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t k = 0; k < m; ++k) {
      const double u = 6.283185307179586 * i / n, v = 6.283185307179586 * k / m, d = 1 + tube * std::cos(v);
      vertices.push_back({d * std::cos(u), d * std::sin(u), tube * std::sin(v)});
      const auto id = [&](std::int32_t a, std::int32_t b) { return a % n * m + b % m; };
      triangles.push_back({id(i, k), id(i + 1, k), id(i + 1, k + 1)});
      triangles.push_back({id(i, k), id(i + 1, k + 1), id(i, k + 1)});
    }
  }
  const Widths widths = widths_of({vertices, triangles});
  EXPECT_NEAR(widths.wall->width, 2 * tube, 0.005);
  EXPECT_NEAR(widths.slot->width, 2 * (1 - tube), 0.005);
  EXPECT_EQ(widths.thin_walls, 0);
  // Searches that end early find the same as those that go on.
  WidthsOptions all;
  all.list_walls = true;
  const Widths listed = widths_of({vertices, triangles}, all);
  EXPECT_EQ(listed.walls.size(), triangles.size());
  EXPECT_EQ(listed.wall->width, widths.wall->width);
  EXPECT_EQ(listed.wall->triangle, widths.wall->triangle);
  EXPECT_EQ(listed.slot->width, widths.slot->width);
  EXPECT_EQ(listed.thin_walls, widths.thin_walls);
  EXPECT_EQ(listed.narrow_slots, widths.narrow_slots);
  EXPECT_EQ(*std::min_element(listed.walls.begin(), listed.walls.end()), widths.wall->width);
  WidthsOptions few;
  few.places = 1000;
  const Widths sparse = widths_of({vertices, triangles}, few);
  EXPECT_LE(sparse.places, 1000);
  EXPECT_GT(sparse.places, 900);
  EXPECT_NEAR(sparse.wall->width, 2 * tube, 0.005);
}

TEST(widths, of_the_flanks_of_an_edge_are_none) {
  // A prism over a triangle with angles of 45 and 90 degrees: no two faces are opposite but the ends.
  const std::vector<Vec3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}};
  const std::vector<Triangle> triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 3}, {1, 4, 3},
                                           {1, 2, 4}, {2, 5, 4}, {2, 0, 5}, {0, 3, 5}};
  const Widths widths = widths_of({vertices, triangles});
  ASSERT_TRUE(widths.wall);
  EXPECT_DOUBLE_EQ(widths.wall->width, 5);
}

}  // namespace
}  // namespace ballflow::geometry
