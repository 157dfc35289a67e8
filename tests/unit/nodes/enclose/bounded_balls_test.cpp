#include "enclose/bounded_balls.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ball_bounds.hpp"
#include "enclose_shapes.hpp"

namespace ballflow::geometry {
namespace {

BoundedBalls bounded(const TriangleMesh& mesh, std::int64_t count, double within, BallGoal goal) {
  BoundedBallsOptions options;
  options.balls = count;
  options.within = within;
  options.goal = goal;
  return bounded_balls(mesh, options);
}

TEST(bounded_balls, one_inside_a_box_is_the_largest) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 2, 3});
  const BoundedBalls found = bounded(box, 1, 0, BallGoal::volume);
  ASSERT_EQ(found.balls.size(), 1U);
  EXPECT_NEAR(found.balls.radii[0], 0.5, 0.005);
  EXPECT_NEAR(found.fit.loss, 6 - 3.14159265 / 6, 0.1);
  expect_bounded(box, found.balls, 0);
}

TEST(bounded_balls, no_point_is_farther_outside_than_allowed) {
  const TriangleMesh two = joined(box_mesh({0, 0, 0}, {1, 1, 4}), box_mesh({2, 0, 0}, {3, 1, 1}));
  for (const TriangleMesh& mesh : {shape("torus?n=300"), two, turned_over(two)}) {
    for (const double within : {0.0, 0.05, 0.3}) {
      const BoundedBalls found =
          bounded(mesh, 8, within, within > 0.1 ? BallGoal::surface : BallGoal::volume);
      EXPECT_GT(found.balls.size(), 1U);
      expect_bounded(mesh, found.balls, within);
    }
  }
}

TEST(bounded_balls, fill_what_is_thinner_than_the_lattice) {
  const TriangleMesh plate = box_mesh({0, 0, 0}, {1, 1, 1e-4});
  const BoundedBalls found = bounded(plate, 10, 0, BallGoal::volume);
  EXPECT_EQ(found.balls.size(), 10U);
  expect_bounded(plate, found.balls, 0);
}

TEST(bounded_balls, cover_more_the_more_there_are_and_the_farther_they_may_stand_out) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 2, 3});
  const auto uncovered = [&](std::int64_t count, double within) {
    return bounded(box, count, within, BallGoal::surface).fit.loss;
  };
  EXPECT_LT(uncovered(30, 0.1), uncovered(10, 0.1));
  EXPECT_LT(uncovered(10, 0.2), uncovered(10, 0.1));
  // One ball around the middle that may stand out by 1.4 reaches the corners, 1.87 away.
  EXPECT_EQ(uncovered(1, 1.4), 0);
}

TEST(bounded_balls, fewer_are_returned_where_more_cover_nothing) {
  EXPECT_EQ(bounded(box_mesh({0, 0, 0}, {1, 1, 1}), 50, 2, BallGoal::volume).balls.size(), 1U);
}

TEST(bounded_balls, refuses_to_cover_a_surface_from_inside) {
  try {
    bounded(box_mesh({0, 0, 0}, {1, 1, 1}), 5, 0, BallGoal::surface);
    ADD_FAILURE() << "balls were found";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("raise within"), std::string::npos) << error.what();
  }
}

TEST(bounded_balls, refuses_meshes_without_an_inside) {
  TriangleMesh open = box_mesh({0, 0, 0}, {1, 1, 1});
  open.triangles = std::vector<Triangle>(open.triangles.begin(), open.triangles.end() - 1);
  const TriangleMesh point{std::vector<Vec3>{{1, 2, 3}}, std::vector<Triangle>{{0, 0, 0}}};
  for (const TriangleMesh& mesh : {open, point, TriangleMesh{}}) {
    try {
      bounded(mesh, 5, 0, BallGoal::volume);
      ADD_FAILURE() << "balls were found";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("inside"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry
