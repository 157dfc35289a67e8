#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mesh/ball_mesh.hpp"
#include "mesh_oracle.hpp"
#include "power/alpha_shape.hpp"

namespace ballflow::geometry {
namespace {

/// A chain of balls that winds around, genus 0, or closed to a ring, genus 1.
Balls chain_of(std::size_t n, bool closed) {
  std::mt19937 random(9);
  std::vector<test::Ball> balls;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = (closed ? 6.283185307179586 : 4.5) * static_cast<double>(i) / static_cast<double>(n);
    const double noise = static_cast<double>(random()) / 4294967296.0;
    balls.push_back({{std::cos(t), std::sin(t), 0.1 * noise}, 0.25 + 0.05 * noise});
  }
  return test::balls_of(balls);
}

TEST(simplified_mesh, keeps_a_closed_manifold_of_the_same_topology) {
  for (const BallMeshMethod method : {BallMeshMethod::exact, BallMeshMethod::grid}) {
    const Balls balls = chain_of(20, true);
    const BallMesh whole = ball_mesh(balls, {.method = method, .error = 1}, no_monitor());
    for (const double keep : {60.0, 20.0}) {
      const BallMesh made =
          ball_mesh(balls, {.method = method, .error = 1, .keep_faces = keep}, no_monitor());
      const MeshReport& report = made.report;
      EXPECT_EQ(report.faces_before, whole.report.faces);
      EXPECT_LE(static_cast<double>(report.faces), keep / 100 * static_cast<double>(whole.report.faces) + 2);
      EXPECT_GE(static_cast<double>(report.faces),
                0.9 * keep / 100 * static_cast<double>(whole.report.faces));
      EXPECT_EQ(test::broken_manifold(made.mesh), "");
      EXPECT_EQ(test::euler_of(made.mesh), 0);
      EXPECT_GE(report.self_intersections, 0) << "counted";
      // Distances are those of the simplified mesh, both ways.
      EXPECT_LE(test::mesh_to_boundary(balls, made.mesh), report.error * 1.05);
      EXPECT_LE(test::boundary_to_mesh(balls, made.mesh, 20), report.error_back * 1.05);
      EXPECT_GE(report.error, whole.report.error * 0.9);
    }
  }
}

TEST(simplified_mesh, says_that_it_is_farther_than_was_asked_for) {
  const BallMesh made = ball_mesh(chain_of(20, true), {.error = 0.2, .keep_faces = 3}, no_monitor());
  EXPECT_NE(what_differs(made.report).find("off"), std::string::npos);
  EXPECT_EQ(test::euler_of(made.mesh), 0);
  EXPECT_THROW(ball_mesh(chain_of(5, true), {.keep_faces = 0}, no_monitor()), InputError);
}

TEST(simplified_mesh, does_not_depend_on_threads) {
  const Balls balls = chain_of(20, true);
  const auto run = [&] { return ball_mesh(balls, {.error = 0.5, .keep_faces = 30}, no_monitor()); };
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const BallMesh alone = run();
  tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
  const BallMesh made = run();
  EXPECT_EQ(made.mesh.vertices, alone.mesh.vertices);
  EXPECT_EQ(made.mesh.triangles, alone.mesh.triangles);
  EXPECT_EQ(made.report.error, alone.report.error);
}

}  // namespace
}  // namespace ballflow::geometry
