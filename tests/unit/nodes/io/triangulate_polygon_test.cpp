#include "io/triangulate_polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>

namespace ballflow::geometry {
namespace {

using Corners = std::vector<std::int32_t>;

Vec3 at(const std::vector<Vec3>& vertices, std::int32_t i) { return vertices[static_cast<std::size_t>(i)]; }

Vec3 area_of(const std::vector<Vec3>& vertices, const Triangle& t) {
  return 0.5 * cross(at(vertices, t[1]) - at(vertices, t[0]), at(vertices, t[2]) - at(vertices, t[0]));
}

Corners numbers(std::size_t count) {
  Corners corners(count);
  std::iota(corners.begin(), corners.end(), 0);
  return corners;
}

struct Made {
  std::vector<Triangle> triangles;
  PolygonTriangulation how;
  double area = 0;      // of all triangles
  Vec3 vector_area;     // of all triangles
  double smallest = 0;  // of one triangle, in the direction of all
};

/// Triangulates, and checks what holds for every polygon: the boundary of the triangles is the polygon.
Made make(const std::vector<Vec3>& vertices, const Corners& corners) {
  Made made;
  made.triangles = {{0, 1, 2}};  // what is there stays
  made.how = triangulate_polygon(vertices, corners, made.triangles);
  EXPECT_EQ(made.triangles.front(), (Triangle{0, 1, 2}));
  made.triangles.erase(made.triangles.begin());
  std::map<std::pair<std::int32_t, std::int32_t>, int> sides;
  const auto add = [&](std::int32_t u, std::int32_t v, int times) {
    if (u != v) sides[std::minmax(u, v)] += u < v ? times : -times;
  };
  for (std::size_t i = 0; i < corners.size(); ++i) add(corners[i], corners[(i + 1) % corners.size()], -1);
  for (const Triangle& t : made.triangles) {
    for (std::size_t k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3], 1);
    made.area += length(area_of(vertices, t));
    made.vector_area = made.vector_area + area_of(vertices, t);
  }
  for (const auto& [side, times] : sides) EXPECT_EQ(times, 0) << side.first << " " << side.second;
  made.smallest = made.area;
  for (const Triangle& t : made.triangles) {
    made.smallest =
        std::min(made.smallest, dot(area_of(vertices, t), made.vector_area) / length(made.vector_area));
  }
  return made;
}

/// With the boundary right and all triangles turned one way, equal areas mean that each point inside is in
/// one triangle, and no other point is in any.
void expect_inside(const Made& made, double area, PolygonShape shape) {
  EXPECT_EQ(made.how.shape, shape);
  EXPECT_NEAR(made.area, area, 1e-12 * area);
  EXPECT_NEAR(length(made.vector_area), area, 1e-12 * area);
  EXPECT_GT(made.smallest, 0);
}

const std::vector<Vec3> ell = {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}};

TEST(triangulate_polygon, a_polygon_that_its_first_corner_sees_is_a_fan) {
  const Made made = make(ell, numbers(6));
  expect_inside(made, 7, PolygonShape::fan);
  EXPECT_EQ(made.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}));
}

TEST(triangulate_polygon, a_concave_one_is_filled_from_whichever_corner_and_side) {
  for (std::size_t first = 1; first < 6; ++first) {
    Corners corners = numbers(6);
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first), corners.end());
    const Made made = make(ell, corners);
    // The corner of the notch sees everything, too.
    expect_inside(made, 7, first == 3 ? PolygonShape::fan : PolygonShape::concave);
    EXPECT_EQ(made.triangles.size(), 4u);
    EXPECT_GT(made.vector_area.z, 0);
    EXPECT_TRUE(made.how.flat);
    std::reverse(corners.begin(), corners.end());
    EXPECT_LT(make(ell, corners).vector_area.z, 0);
  }
}

TEST(triangulate_polygon, corners_on_a_side_make_no_triangle_without_area) {
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0},
                                    {3, 1, 0}, {3, 2, 0}, {0, 2, 0}};
  const Made made = make(square, numbers(7));
  expect_inside(made, 6, PolygonShape::filled);
  EXPECT_EQ(made.triangles.size(), 5u);
}

TEST(triangulate_polygon, random_ones_in_random_planes_are_filled) {
  std::mt19937_64 random(1);
  int concave = 0;
  for (int round = 0; round < 400; ++round) {
    SCOPED_TRACE(round);
    // A simple polygon: corners by angle around the origin, on a grid, so that many are collinear. In one of
    // the planes x + i y + j z = 0 and their mirrors, whose points (as all here) are exact doubles.
    std::map<double, std::pair<double, double>> by_angle;
    const std::size_t n = 5 + random() % 40;
    for (std::size_t k = 0; k < n; ++k) {
      const double x = static_cast<double>(random() % 33) - 16, y = static_cast<double>(random() % 33) - 16;
      if (x == 0 && y == 0) continue;
      const double g = std::gcd(static_cast<int>(x), static_cast<int>(y));
      by_angle.try_emplace(std::atan2(y / g, x / g), x, y);
    }
    const double i = static_cast<double>(random() % 5) - 2, j = static_cast<double>(random() % 5) - 2;
    const std::size_t turn = random() % 3;
    std::vector<Vec3> vertices;
    std::vector<double> angles;
    double twice = 0, x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    for (const auto& [angle, p] : by_angle) {
      const auto [x, y] = p;
      if (vertices.empty()) {
        x1 = x, y1 = y;
      } else {
        twice += x0 * y - x * y0;
      }
      x0 = x, y0 = y;
      const double z = -(i * x + j * y);
      vertices.push_back(turn == 0 ? Vec3{x, y, z} : turn == 1 ? Vec3{z, x, y} : Vec3{y, z, x});
      angles.push_back(angle);
    }
    twice += x0 * y1 - x1 * y0;
    bool around = vertices.size() > 3;  // no half of the plane without corners: the origin is inside
    for (std::size_t k = 0; k < angles.size(); ++k) {
      const double next = k + 1 < angles.size() ? angles[k + 1] : angles[0] + 2 * std::numbers::pi;
      around = around && next - angles[k] < 3.1;
    }
    if (!around) continue;
    Corners corners = numbers(vertices.size());
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random() % corners.size()),
                corners.end());
    const Made made = make(vertices, corners);
    const double area = twice / 2 * std::sqrt(1 + i * i + j * j);
    expect_inside(made, area, made.how.shape);
    EXPECT_NE(made.how.shape, PolygonShape::crossing);
    EXPECT_EQ(made.triangles.size(), vertices.size() - 2);
    EXPECT_TRUE(made.how.flat);
    concave += made.how.shape == PolygonShape::concave;
  }
  EXPECT_GT(concave, 100);
}

TEST(triangulate_polygon, islands_on_bridges_stay_empty) {
  // A square with a square hole in it, and the bridge from 0 to 4 twice.
  const std::vector<Vec3> vertices = {{0, 0, 1}, {5, 0, 1}, {5, 5, 1}, {0, 5, 1},
                                      {2, 2, 1}, {2, 3, 1}, {3, 3, 1}, {3, 2, 1}};
  const Made made = make(vertices, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4});
  expect_inside(made, 24, PolygonShape::concave);
  EXPECT_EQ(made.triangles.size(), 8u);
}

TEST(triangulate_polygon, parts_that_meet_in_a_corner_are_filled_both) {
  const std::vector<Vec3> vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {4, 2, 0},
                                      {4, 4, 0}, {2, 4, 0}, {0, 2, 0}};
  expect_inside(make(vertices, {0, 1, 2, 3, 4, 5, 2, 6}), 8, PolygonShape::concave);
}

TEST(triangulate_polygon, what_crosses_itself_keeps_its_boundary) {
  const std::vector<Vec3> bow = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}};
  EXPECT_EQ(make(bow, numbers(4)).how.shape, PolygonShape::crossing);
  // A corner in the middle of another side.
  const std::vector<Vec3> touching = {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 0, 0}, {0, 2, 0}};
  EXPECT_EQ(make(touching, numbers(5)).how.shape, PolygonShape::crossing);
  // Twice around; on a line.
  const std::vector<Vec3> square = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_EQ(make(square, {0, 1, 2, 3, 0, 1, 2, 3}).how.shape, PolygonShape::crossing);
  const std::vector<Vec3> line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_EQ(make(line, numbers(4)).how.shape, PolygonShape::crossing);
}

TEST(triangulate_polygon, a_side_there_and_back_is_no_area) {
  const std::vector<Vec3> square = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {3, 3, 0}};
  expect_inside(make(square, {0, 1, 2, 4, 2, 3}), 4, PolygonShape::concave);
}

TEST(triangulate_polygon, a_bent_one_is_filled_as_it_is_seen_along_its_normal) {
  std::vector<Vec3> bent = ell;
  bent[4].z = bent[5].z = 2;  // the one arm of the L rises
  const Made made = make(bent, {1, 2, 3, 4, 5, 0});
  EXPECT_EQ(made.how.shape, PolygonShape::concave);
  EXPECT_FALSE(made.how.flat);
  EXPECT_NEAR(made.vector_area.z, 7, 1e-12);
  for (const Triangle& t : made.triangles) EXPECT_GT(area_of(bent, t).z, 0);
}

TEST(triangulate_polygon, one_that_crosses_itself_along_its_normal_is_seen_along_another_axis) {
  // Most of its area is seen along z, where two sides cross; along x it is convex.
  const std::vector<Vec3> twisted = {{0, 0, 0}, {6, 3, 0}, {5, 3.125, 1}, {10, 0, 1}};
  EXPECT_EQ(make(twisted, numbers(4)).how.shape, PolygonShape::fan);
  // With a notch beside the first corner.
  std::vector<Vec3> notched = twisted;
  notched.push_back({5, 2, 0.25});
  notched.push_back({0, 0.5, 0.125});
  const Made made = make(notched, numbers(6));
  EXPECT_EQ(made.how.shape, PolygonShape::concave);
  EXPECT_FALSE(made.how.flat);
  for (const Triangle& t : made.triangles) EXPECT_GT(area_of(notched, t).x, 0);
}

TEST(triangulate_polygon, ends_when_it_is_cancelled) {
  class Impatient final : public Monitor {
    bool cancelled() override { return true; }
  };
  Impatient monitor;
  std::vector<Triangle> out;
  EXPECT_THROW(triangulate_polygon(ell, Corners{1, 2, 3, 4, 5, 0}, out, monitor), Cancelled);
}

}  // namespace
}  // namespace ballflow::geometry
