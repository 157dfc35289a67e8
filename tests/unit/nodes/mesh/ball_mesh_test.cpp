#include "mesh/ball_mesh.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mesh_oracle.hpp"
#include "power/alpha_shape.hpp"
#include "search/self_intersection.hpp"

namespace ballflow::geometry {
namespace {

using test::Ball;
using test::balls_of;

constexpr double pi_ = 3.14159265358979323846;

/// Meshes the balls and holds the result against what must be true of every mesh.
BallMesh meshed(const Balls& balls, double error, BallMeshMethod method = BallMeshMethod::exact) {
  BallMesh made = ball_mesh(balls, {.method = method, .error = error, .refine_notches = true}, no_monitor());
  const MeshReport& report = made.report;
  EXPECT_EQ(broken_invariant(made.mesh), "");
  EXPECT_EQ(broken_invariant(report), "");
  EXPECT_EQ(what_differs(report), "");
  EXPECT_EQ(test::broken_manifold(made.mesh), "");
  EXPECT_EQ(test::euler_of(made.mesh), report.euler);
  EXPECT_EQ(report.euler, 2 * report.euler_meshed);
  EXPECT_EQ(report.euler_given, alpha_shape(balls, {}, no_monitor()).euler_characteristic());
  EXPECT_EQ(report.faces, static_cast<std::int64_t>(made.mesh.triangles.size()));
  EXPECT_DOUBLE_EQ(report.error_asked, error / 100 * bounding_box(balls).longest_edge());
  const double there = test::mesh_to_boundary(balls, made.mesh);
  EXPECT_LE(there, report.error * (1 + 1e-9)) << "stated";
  EXPECT_LE(there, report.error_asked) << "asked";
  return made;
}
BallMesh meshed(const std::vector<Ball>& list, double error, BallMeshMethod method = BallMeshMethod::exact) {
  return meshed(balls_of(list), error, method);
}

/// Balls in a cube of edge 1.
std::vector<Ball> random_balls(std::size_t n, double least, double most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit;
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 c{unit(random), unit(random), unit(random)};
    balls.push_back({c, least * std::pow(most / least, unit(random))});
  }
  return balls;
}

std::vector<Ball> ring(int n, double radius, double r) {
  std::vector<Ball> balls;
  for (int k = 0; k < n; ++k) {
    const double t = 2 * pi_ * k / n;
    balls.push_back({{radius * std::cos(t), radius * std::sin(t), 0}, r});
  }
  return balls;
}

/// Balls for a method: the grid does not resolve the notches of random ones.
std::vector<Ball> balls_for(BallMeshMethod method, unsigned seed) {
  if (method == BallMeshMethod::exact) return random_balls(200, 0.05, 0.2, seed);
  std::vector<Ball> balls = ring(24, 1, 0.3);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit;
  for (Ball& b : balls) b = {b.c + Vec3{0, 0, 0.1 * unit(random)}, b.r + 0.05 * unit(random)};
  return balls;
}

std::vector<Ball> lattice(int n, double r) {
  std::vector<Ball> balls;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k)
        balls.push_back({{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}, r});
    }
  }
  return balls;
}

MeshedBy how(const BallMesh& made) { return static_cast<MeshedBy>(made.report.made_by); }

TEST(ball_mesh, a_whole_sphere_is_as_near_as_was_asked_for) {
  for (const double error : {20.0, 5.0, 1.0, 0.35, 0.1}) {
    const BallMesh made = meshed({{{1, 2, 3}, 2}}, error);
    EXPECT_EQ(made.report.euler, 2);
    EXPECT_LE(test::boundary_to_mesh(balls_of({{{1, 2, 3}, 2}}), made.mesh, 500), made.report.error_asked);
    const double ball = 4 * pi_ / 3 * 8, volume = test::volume_of(made.mesh);
    EXPECT_LT(volume, ball);
    EXPECT_GT(volume, ball * std::pow(1 - error / 50, 3));
  }
}

TEST(ball_mesh, few_balls_of_every_kind) {
  const Ball unit{{0, 0, 0}, 1};
  EXPECT_EQ(meshed({unit, {{1, 0, 0}, 0.7}}, 1).report.euler, 2);    // a ring between two
  EXPECT_EQ(meshed({unit, {{3, 0, 0}, 0.7}}, 1).report.euler, 4);    // apart
  EXPECT_EQ(meshed({unit, {{0.1, 0, 0}, 0.2}}, 1).report.euler, 2);  // nested
  EXPECT_EQ(meshed({unit, unit}, 1).report.euler, 2);                // equal
  EXPECT_EQ(meshed({unit, {{1, 0, 0}, 1}, {{2, 0, 0}, 1}, {{3, 0, 0}, 1}}, 1).report.euler, 2);  // a chain
  EXPECT_EQ(meshed({unit, {{1, 0, 0}, 1}, {{0.5, 0.9, 0}, 1}}, 1).report.euler, 2);              // coplanar
  EXPECT_EQ(meshed({unit, {{1, 0, 0}, 1}, {{0.5, 0.9, 0}, 1}, {{0.4, 0.4, 0.8}, 1}}, 1).report.euler, 2);
  EXPECT_EQ(meshed(ring(12, 1, 0.4), 1).report.euler, 0);                   // a torus
  EXPECT_EQ(meshed({unit, {{1.0000001, 0, 0}, 1e-6}}, 1).report.euler, 2);  // a tiny bump
  EXPECT_EQ(meshed({unit, {{1.1, 0, 0}, 1e-6}}, 1).report.euler, 4);        // a tiny ball
}

TEST(ball_mesh, general_position_is_meshed_as_it_is) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const std::vector<Ball> balls = random_balls(150, 0.05, 0.25, seed);
    const BallMesh made = meshed(balls, 0.5);
    EXPECT_EQ(how(made), MeshedBy::exact) << seed;
    EXPECT_EQ(made.report.growth, 0);
    EXPECT_LE(test::boundary_to_mesh(balls_of(balls), made.mesh, 40), made.report.error_asked) << seed;
  }
}

TEST(ball_mesh, radii_of_four_orders_of_magnitude) {
  const std::vector<Ball> balls = random_balls(800, 1e-5, 0.2, 3);
  EXPECT_EQ(how(meshed(balls, 0.5)), MeshedBy::exact);
}

TEST(ball_mesh, cavities_have_a_surface_of_their_own_that_faces_into_them) {
  std::vector<Ball> balls;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 300; ++k) {
    const Vec3 d{normal(random), normal(random), normal(random)};
    balls.push_back({1 / length(d) * d, 0.35});
  }
  const BallMesh made = meshed(balls, 0.5);
  EXPECT_EQ(made.report.components, 2);
  EXPECT_EQ(made.report.euler, 4);
  EXPECT_LT(test::volume_of(made.mesh), 4 * pi_ / 3 * (std::pow(1.35, 3) - std::pow(0.6, 3)));
}

TEST(ball_mesh, many_whole_circles_on_one_sphere) {
  std::vector<Ball> balls{{{0, 0, 0}, 1}};
  for (int k = 0; k < 150; ++k) {  // a spiral of spikes
    const double z = 1 - (2 * k + 1) / 150.0, t = 2.39996322972865332 * k, s = std::sqrt(1 - z * z);
    balls.push_back({{s * std::cos(t), s * std::sin(t), z}, 0.05});
  }
  const BallMesh made = meshed(balls, 0.1);
  EXPECT_EQ(how(made), MeshedBy::exact);
  EXPECT_EQ(made.report.euler, 2);
  EXPECT_LE(test::boundary_to_mesh(balls_of(balls), made.mesh, 20), made.report.error_asked);
}

TEST(ball_mesh, a_sphere_of_which_hardly_anything_is_hidden_is_there_all_around) {
  // Around the tiny circle of the two the plane of projection is very large.
  for (const double r : {0.3, 0.03, 0.003}) {
    const std::vector<Ball> balls{{{0, 0, 0}, 1}, {{1, 0, 0}, r}};
    for (const double error : {0.2, 3.0, 8.0}) {
      const BallMesh made = meshed(balls, error);
      EXPECT_LE(test::boundary_to_mesh(balls_of(balls), made.mesh, 500), made.report.error_asked)
          << r << " " << error;
    }
  }
}

TEST(ball_mesh, balls_on_integers_and_through_common_points) {
  for (unsigned seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto integer = [&](int n) { return static_cast<double>(random() % static_cast<unsigned>(n)); };
    std::vector<Ball> balls;
    for (unsigned k = 0; k < 2 + seed / 2; ++k) {
      const Vec3 c{integer(4), integer(4), seed % 3 == 2 ? 0.0 : integer(4)};
      balls.push_back({c, seed % 3 == 0 ? 0.5 * (1 + integer(3)) : std::sqrt((1 + integer(5)) / 2)});
    }
    const BallMesh made = meshed(balls, 2);
    EXPECT_NE(how(made), MeshedBy::grid);
    if (seed % 10 == 0) {
      EXPECT_LE(test::boundary_to_mesh(balls_of(balls), made.mesh, 20), made.report.error_asked);
    }
  }
}

TEST(ball_mesh, balls_that_touch_are_joined) {
  const BallMesh outside = meshed({{{0, 0, 0}, 1}, {{2, 0, 0}, 1}}, 1);
  EXPECT_EQ(how(outside), MeshedBy::exact_grown);
  EXPECT_EQ(outside.report.euler, 2);
  EXPECT_GT(outside.report.growth, 0);
  EXPECT_LE(outside.report.growth, 1e-6 * 4);
  EXPECT_EQ(meshed({{{0, 0, 0}, 1}, {{0.5, 0, 0}, 0.5}}, 1).report.euler, 2);  // from inside
}

TEST(ball_mesh, degenerate_input_is_a_closed_manifold_of_the_topology_of_the_complex) {
  const double corner = std::sqrt(3.0) / 2, diagonal = std::sqrt(2.0) / 2;
  const std::vector<std::pair<std::string, std::vector<Ball>>> all{
      {"six through one point", ring(6, 1, 1)},
      {"lattice meeting in corners", lattice(3, corner)},
      {"lattice meeting in corners, squares exact", lattice(3, 0.75)},
      {"lattice meeting in the middle of faces", lattice(3, diagonal)},
      {"tangent lattice", lattice(3, 0.5)},
  };
  for (const auto& [name, balls] : all) {
    SCOPED_TRACE(name);
    const BallMesh made = meshed(balls, 1);
    EXPECT_NE(how(made), MeshedBy::grid);
    EXPECT_LE(std::abs(made.report.growth), 1e-6 * bounding_box(balls_of(balls)).longest_edge());
  }
}

TEST(ball_mesh, balls_through_common_points_like_raw_polar_balls) {
  // Balls that touch a sphere from inside in random points, and pass through the corners of a cube on it.
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit;
  std::vector<Ball> balls;
  for (int k = 0; k < 60; ++k) {
    const Vec3 c{unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
    const int b = k % 8;
    const Vec3 through{(b & 1) != 0 ? 1.0 : -1.0, (b & 2) != 0 ? 1.0 : -1.0, (b & 4) != 0 ? 1.0 : -1.0};
    balls.push_back({c, distance(c, through)});
  }
  EXPECT_NE(how(meshed(balls, 1)), MeshedBy::grid);
}

TEST(ball_mesh, a_ball_of_radius_0_apart_becomes_a_tiny_one) {
  const BallMesh made = meshed({{{0, 0, 0}, 1}, {{3, 0, 0}, 0}}, 1);
  EXPECT_EQ(how(made), MeshedBy::exact_grown);
  EXPECT_EQ(made.report.euler, 4);
}

TEST(ball_mesh, no_ball_gives_an_empty_mesh) {
  const BallMesh made = ball_mesh({}, {}, no_monitor());
  EXPECT_EQ(made.mesh.vertices.size() + made.mesh.triangles.size(), 0U);
  EXPECT_EQ(broken_invariant(made.report), "");
}

TEST(ball_mesh, refuses_what_has_no_mesh_in_words) {
  EXPECT_THROW(ball_mesh(balls_of({{{1, 2, 3}, 0}}), {}, no_monitor()), InputError);
  EXPECT_THROW(ball_mesh(balls_of({{{1, 2, 3}, -1}}), {}, no_monitor()), InputError);
  EXPECT_THROW(ball_mesh(balls_of({{{1, 2, 3}, 1}}), {.error = 0}, no_monitor()), InputError);
  EXPECT_THROW(ball_mesh(balls_of({{{1, 2, 3}, 1}}), {.error = std::nan("")}, no_monitor()), InputError);
  EXPECT_THROW(
      ball_mesh(balls_of(random_balls(50, 0.1, 0.2, 1)), {.error = 0.01, .most_faces = 100}, no_monitor()),
      InputError);
}

/// Without looking at it: others do.
BallMesh made_of(const std::vector<Ball>& balls, BallMeshMethod method = BallMeshMethod::exact) {
  return ball_mesh(balls_of(balls), {.method = method, .error = 1}, no_monitor());
}

TEST(ball_mesh, does_not_depend_on_threads) {
  for (const BallMeshMethod method : {BallMeshMethod::exact, BallMeshMethod::grid}) {
    std::vector<BallMesh> made;
    for (const std::size_t threads : {1, 2, 4}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      made.push_back(made_of(balls_for(method, 11), method));
    }
    for (const BallMesh& other : made) {
      EXPECT_EQ(other.mesh.vertices, made[0].mesh.vertices);
      EXPECT_EQ(other.mesh.triangles, made[0].mesh.triangles);
    }
  }
}

TEST(ball_mesh, does_not_depend_on_the_order_of_the_balls) {
  for (const BallMeshMethod method : {BallMeshMethod::exact, BallMeshMethod::grid}) {
    std::vector<Ball> balls = balls_for(method, 13);
    const BallMesh a = made_of(balls, method);
    std::shuffle(balls.begin(), balls.end(), std::mt19937(1));
    const BallMesh b = made_of(balls, method);
    EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  }
}

TEST(ball_mesh, is_twice_as_large_for_balls_twice_as_large) {
  for (const BallMeshMethod method : {BallMeshMethod::exact, BallMeshMethod::grid}) {
    const std::vector<Ball> balls = balls_for(method, 17);
    const BallMesh a = made_of(balls, method);
    std::vector<Ball> twice = balls;
    for (Ball& b : twice) b = {2.0 * b.c, 2 * b.r};
    const BallMesh b = made_of(twice, method);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    std::vector<Vec3> vertices;
    for (const Vec3 v : a.mesh.vertices) vertices.push_back(2.0 * v);
    EXPECT_EQ(Array<Vec3>(vertices), b.mesh.vertices);
  }
}

TEST(ball_mesh, is_mirrored_for_mirrored_balls) {
  const auto mirrored = [](Vec3 p, int axis) {
    return axis == 0 ? Vec3{-p.x, p.y, p.z} : axis == 1 ? Vec3{p.x, -p.y, p.z} : Vec3{p.x, p.y, -p.z};
  };
  for (unsigned seed = 20; seed < 23; ++seed) {
    const std::vector<Ball> balls = random_balls(200, 0.05, 0.2, seed);
    const BallMesh a = made_of(balls);
    for (const int axis : {0, 1, 2}) {
      std::vector<Ball> image = balls;
      for (Ball& b : image) b.c = mirrored(b.c, axis);
      const BallMesh b = made_of(image);
      TriangleMesh back;
      std::vector<Vec3> vertices;
      std::vector<Triangle> triangles;
      for (const Vec3 v : b.mesh.vertices) vertices.push_back(mirrored(v, axis));
      for (const Triangle& t : b.mesh.triangles) triangles.push_back({t[0], t[2], t[1]});
      EXPECT_TRUE(test::soup_of(a.mesh) == test::soup_of({vertices, triangles})) << seed << " " << axis;
    }
  }
}

TEST(ball_mesh, grid_is_near_enough_and_has_the_right_topology) {
  for (unsigned seed = 30; seed < 33; ++seed) {
    const std::vector<Ball> balls = balls_for(BallMeshMethod::grid, seed);
    const BallMesh made = meshed(balls, 1, BallMeshMethod::grid);
    EXPECT_EQ(how(made), MeshedBy::grid);
    EXPECT_GT(made.report.cell, 0);
    EXPECT_LE(test::boundary_to_mesh(balls_of(balls), made.mesh, 20), made.report.error_asked) << seed;
  }
  EXPECT_EQ(meshed({{{0, 0, 0}, 1}}, 1, BallMeshMethod::grid).report.euler, 2);
  EXPECT_EQ(meshed({{{0, 0, 0}, 1}, {{4, 0, 0}, 1}}, 1, BallMeshMethod::grid).report.euler, 4);
}

TEST(ball_mesh, grid_is_a_closed_manifold_whatever_the_balls) {
  for (unsigned seed = 40; seed < 44; ++seed) {
    const BallMesh made = ball_mesh(balls_of(random_balls(100, 0.02, 0.3, seed)),
                                    {.method = BallMeshMethod::grid, .error = 4}, no_monitor());
    EXPECT_EQ(test::broken_manifold(made.mesh), "");
    EXPECT_EQ(test::euler_of(made.mesh), made.report.euler);
    EXPECT_LE(made.report.error, made.report.error_asked);
    const bool notches_kept = made.report.error_back <= made.report.error_asked;
    EXPECT_EQ(what_differs(made.report).empty(), made.report.right_topology() && notches_kept);
  }
}

TEST(ball_mesh, a_grid_says_how_far_the_bottoms_of_notches_are) {
  std::vector<double> found;
  // A wide notch between two balls, a sharp one, and one around a ball between the corners of the grid.
  const std::vector<Ball> sharp{{{0, 0, 0}, 1}, {{1.93, 0.1, 0.05}, 1}, {{0.5, 1.1, 0.3}, 0.8}};
  std::vector<Ball> wide = sharp, bump = sharp;
  wide[1].c.x = 1.2;
  bump.push_back({{0, -0.6, -0.8}, 0.12});
  for (const std::vector<Ball>& list : {wide, sharp, bump}) {
    const Balls balls = balls_of(list);
    const BallMesh made = ball_mesh(balls, {.method = BallMeshMethod::grid, .error = 2.5}, no_monitor());
    const MeshReport& report = made.report;
    const double back = test::boundary_to_mesh(balls, made.mesh, 1000);
    EXPECT_LE(back, report.error_back * 1.02) << "what random places say is not above it by much";
    EXPECT_GE(back, 0.6 * std::max(report.error, report.error_back)) << "nor far below";
    EXPECT_EQ(what_differs(report).find("notches") != std::string::npos,
              report.error_back > report.error_asked);
    found.push_back(report.error_back / report.error_asked);
    const BallMesh finer = ball_mesh(
        balls, {.method = BallMeshMethod::grid, .error = 2.5, .refine_notches = true}, no_monitor());
    EXPECT_LE(finer.report.error_back, finer.report.error_asked);
    EXPECT_LE(test::boundary_to_mesh(balls, finer.mesh, 300), finer.report.error_asked);
  }
  EXPECT_LE(found[1], 1) << "the sharp one has vertices in its bottom";
  EXPECT_GT(found.back(), 1) << "the last one is farther than was asked for";
  EXPECT_EQ(ball_mesh(balls_of({{{0, 0, 0}, 1}}), {}, no_monitor()).report.error_back, -1) << "exact";
}

/// Balls along the edges of a cube, each with a radius and a place of its own: five loops, a sharp notch
/// between neighbours, and a third ball in its bottom in some places.
std::vector<Ball> frame(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit;
  std::vector<Ball> balls;
  const auto add = [&](Vec3 c, double least) {
    const Vec3 off{unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
    balls.push_back({c + 0.05 * off, least + 0.05 * unit(random)});
  };
  for (int a = 0; a < 8; ++a) {
    const auto corner = [](int k) { return Vec3{1.0 * (k & 1), 1.0 * (k >> 1 & 1), 1.0 * (k >> 2)}; };
    add(corner(a), 0.14);
    for (const int bit : {1, 2, 4}) {
      if ((a & bit) != 0) continue;
      for (int k = 1; k < 7; ++k) add(corner(a) + k / 7.0 * (corner(a | bit) - corner(a)), 0.11);
    }
  }
  return balls;
}

TEST(ball_mesh, a_grid_keeps_the_bottoms_of_notches) {
  for (unsigned seed = 0; seed < 2; ++seed) {
    SCOPED_TRACE(seed);
    const Balls balls = balls_of(frame(seed));
    std::vector<BallMesh> made;
    for (const std::size_t threads : {1, 4}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      made.push_back(ball_mesh(balls, {.method = BallMeshMethod::grid, .error = 1}, no_monitor()));
    }
    const MeshReport& report = made[0].report;
    EXPECT_EQ(what_differs(report), "");
    EXPECT_LE(report.error, report.error_asked);
    EXPECT_LE(report.error_back, report.error_asked);
    EXPECT_LE(test::mesh_to_boundary(balls, made[0].mesh), report.error);
    EXPECT_LE(test::boundary_to_mesh(balls, made[0].mesh, 8), report.error_asked);
    EXPECT_EQ(test::broken_manifold(made[0].mesh), "");
    EXPECT_EQ(test::euler_of(made[0].mesh), 2 * alpha_shape(balls, {}, no_monitor()).euler_characteristic());
    EXPECT_LT(report.self_intersections, report.faces / 500);
    const SelfIntersections crossing = self_intersections(made[0].mesh, 1'000'000, no_monitor());
    EXPECT_EQ(report.self_intersections, static_cast<std::int64_t>(crossing.pairs.size()));
    EXPECT_EQ(made[1].mesh.vertices, made[0].mesh.vertices);
    EXPECT_EQ(made[1].mesh.triangles, made[0].mesh.triangles);
  }
}

TEST(ball_mesh, a_grid_says_where_it_cannot_have_the_topology) {
  const BallMesh made = ball_mesh(balls_of({{{0, 0, 0}, 1}, {{2, 0.123, 0.077}, 1e-7}}),
                                  {.method = BallMeshMethod::grid, .error = 5}, no_monitor());
  EXPECT_EQ(test::broken_manifold(made.mesh), "");
  EXPECT_NE(what_differs(made.report).find("components"), std::string::npos);
}

}  // namespace
}  // namespace ballflow::geometry
