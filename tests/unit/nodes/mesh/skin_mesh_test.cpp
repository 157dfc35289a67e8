#include "mesh/skin_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "mesh/ball_mesh.hpp"
#include "mesh_oracle.hpp"
#include "power/alpha_shape.hpp"

namespace ballflow::geometry {
namespace {

using test::Ball;
using test::balls_of;

std::vector<Ball> some_balls(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit;
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < n; ++i)
    balls.push_back({{unit(random), unit(random), unit(random)}, 0.05 + 0.2 * unit(random)});
  return balls;
}

BallMesh skin_of(const Balls& balls, double shrink) {
  return ball_mesh(balls, {.method = BallMeshMethod::skin, .shrink = shrink}, no_monitor());
}

/// How a place lies to the skin of two balls, times a length; 0 on it. Of all balls between the grown two, on
/// the segment of their centres, the shrunken one that is nearest counts.
double skin_of_two(Vec3 x, const Ball& a, const Ball& b, double shrink) {
  const double da = squared_length(a.c) - a.r * a.r / shrink, db = squared_length(b.c) - b.r * b.r / shrink;
  const auto power = [&](double t) {
    const Vec3 z = a.c + t * (b.c - a.c);
    return squared_distance(x, z) - shrink * (squared_length(z) - (1 - t) * da - t * db);
  };
  double low = 0, high = 1;  // it is convex
  for (int k = 0; k < 200; ++k) {
    const double third = (high - low) / 3;
    if (power(low + third) < power(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return power(low);
}

TEST(skin_mesh, vertices_lie_on_the_envelope_of_the_shrunken_pencil) {
  for (const double shrink : {0.2, 0.5, 0.8}) {
    for (unsigned seed = 0; seed < 4; ++seed) {
      const std::vector<Ball> balls = some_balls(2, seed);
      const BallMesh made = skin_of(balls_of(balls), shrink);
      EXPECT_GT(made.mesh.vertices.size(), 40U);
      for (const Vec3 v : made.mesh.vertices)
        EXPECT_NEAR(skin_of_two(v, balls[0], balls[1], shrink), 0, 1e-8);
    }
  }
}

/// What holds of every skin.
void check(const Balls& balls, const BallMesh& made, double shrink) {
  const MeshReport& report = made.report;
  EXPECT_EQ(broken_invariant(made.mesh), "");
  EXPECT_EQ(broken_invariant(report), "");
  EXPECT_EQ(test::broken_manifold(made.mesh), "");
  EXPECT_TRUE(report.right_topology());
  EXPECT_EQ(test::euler_of(made.mesh), report.euler);
  std::vector<double> radii;
  for (const double r : balls.radii) radii.push_back((r + 1e-9) / std::sqrt(shrink));
  EXPECT_EQ(report.euler,
            2 * alpha_shape(Balls{balls.centers, radii, {}, {}}, {}, no_monitor()).euler_characteristic());
  const double extent = bounding_box(balls).longest_edge();
  for (const Vec3 v : made.mesh.vertices) {
    for (std::size_t i = 0; i < balls.size(); ++i)
      ASSERT_GT(distance(v, balls.centers[i]) - balls.radii[i], -1e-8 * extent) << "a ball stands out";
  }
  EXPECT_LE(test::mesh_to_boundary(balls, made.mesh), report.error);
}

TEST(skin_mesh, closed_manifolds_around_the_balls_of_the_topology_that_is_said) {
  for (unsigned seed = 0; seed < 2; ++seed) {
    const Balls balls = balls_of(some_balls(40, seed));
    for (const double shrink : {0.1, 0.5, 0.9}) check(balls, skin_of(balls, shrink), shrink);
  }
}

TEST(skin_mesh, ties_are_no_trouble) {
  std::vector<Ball> lattice, line, plane, integers;
  for (int k = 0; k < 27; ++k) lattice.push_back({{k / 9 * 1.0, k / 3 % 3 * 1.0, k % 3 * 1.0}, 0.75});
  for (int k = 0; k < 5; ++k) line.push_back({{k * 1.0, 0, 0}, 1});
  for (int k = 0; k < 16; ++k) plane.push_back({{k / 4 * 1.0, k % 4 * 1.0, 0}, 0.6});
  std::mt19937 random(7);
  for (int k = 0; k < 40; ++k) {
    const auto n = [&] { return static_cast<double>(random() % 5); };
    integers.push_back({{n(), n(), n()}, 1 + n() / 4});
  }
  const Ball unit{{0, 0, 0}, 1};
  const std::vector<std::vector<Ball>> all{lattice,
                                           line,
                                           plane,
                                           integers,
                                           {unit},
                                           {unit, unit, unit},
                                           {unit, {{0.5, 0, 0}, 0.5}},
                                           {unit, {{50, 3, 0}, 0.001}}};
  for (std::size_t k = 0; k < all.size(); ++k) {
    SCOPED_TRACE(k);
    const Balls balls = balls_of(all[k]);
    check(balls, skin_of(balls, 0.45), 0.45);
  }
}

TEST(skin_mesh, does_not_depend_on_addresses_or_the_order_of_the_balls) {
  std::vector<Ball> balls = some_balls(80, 5);
  const BallMesh first = skin_of(balls_of(balls), 0.5);
  std::mt19937 random(1);
  for (int k = 0; k < 4; ++k) {
    // What was freed in another order is handed out in another order.
    std::vector<std::unique_ptr<char[]>> blocks;
    for (int i = 0; i < 20'000; ++i) blocks.push_back(std::make_unique<char[]>(16 + random() % 400));
    std::shuffle(blocks.begin(), blocks.end(), random);
    blocks.resize(blocks.size() / 2);
    std::shuffle(balls.begin(), balls.end(), random);
    const BallMesh again = skin_of(balls_of(balls), 0.5);
    EXPECT_EQ(again.mesh.vertices, first.mesh.vertices);
    EXPECT_EQ(again.mesh.triangles, first.mesh.triangles);
  }
}

TEST(skin_mesh, is_twice_as_large_for_balls_twice_as_large) {
  std::vector<Ball> balls = some_balls(50, 8);
  const BallMesh one = skin_of(balls_of(balls), 0.5);
  for (Ball& b : balls) b = {2.0 * b.c, 2 * b.r};
  const BallMesh two = skin_of(balls_of(balls), 0.5);
  std::vector<Vec3> vertices;
  for (const Vec3 v : one.mesh.vertices) vertices.push_back(2.0 * v);
  EXPECT_EQ(two.mesh.vertices, Array<Vec3>(vertices));
  EXPECT_EQ(two.mesh.triangles, one.mesh.triangles);
}

TEST(skin_mesh, says_that_it_closes_gaps_and_refuses_what_it_cannot_shrink) {
  const Balls apart = balls_of({{{0, 0, 0}, 1}, {{2.2, 0, 0}, 1}});
  const BallMesh joined = skin_of(apart, 0.5);
  EXPECT_EQ(joined.report.components, 1);
  EXPECT_NE(what_differs(joined.report).find("closes gaps"), std::string::npos);
  EXPECT_EQ(skin_of(apart, 0.95).report.components, 2);
  EXPECT_EQ(what_differs(skin_of(apart, 0.95).report), "");
  EXPECT_THROW(skin_of(apart, 1), InputError);
  EXPECT_THROW(skin_of(apart, 0), InputError);
  EXPECT_THROW(ball_mesh(apart, {.method = BallMeshMethod::skin, .most_faces = 50}, no_monitor()),
               InputError);
}

}  // namespace
}  // namespace ballflow::geometry
