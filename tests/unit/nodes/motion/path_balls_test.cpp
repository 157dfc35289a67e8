#include "motion/path_balls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "motion/mirror.hpp"

namespace ballflow::geometry {
namespace {

Path path_of(std::vector<Vec3> points, std::vector<double> radii) {
  Path path;
  path.points = std::move(points);
  path.radii = std::move(radii);
  return path;
}

Path read(const std::string& text, double width = 0, double scale = 1) {
  return read_path(text, width, scale);
}

std::string refusal(const std::string& text, double width = 0) {
  try {
    read(text, width);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// How deep a point is in the union of the balls: the largest r - |x - c|.
double depth(const Balls& balls, Vec3 x) {
  double deepest = -1e300;
  for (std::size_t i = 0; i < balls.size(); ++i)
    deepest = std::max(deepest, balls.radii[i] - distance(balls.centers[i], x));
  return deepest;
}

Vec3 direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  for (;;) {
    const Vec3 v{normal(random), normal(random), normal(random)};
    if (length(v) > 0.1) return (1 / length(v)) * v;
  }
}

/// Points of the path: on the spheres around points of the polyline, half of them at right angles to it,
/// where balls side by side leave most out.
template <class Visit>
void for_points_of(const Path& path, std::mt19937& random, int count, Visit visit) {
  std::uniform_int_distribution<std::size_t> segment(0, path.size() - 2);
  std::uniform_real_distribution<double> along(0, 1);
  for (int i = 0; i < count; ++i) {
    const std::size_t s = segment(random);
    const double t = along(random);
    const Vec3 way = path.points[s + 1] - path.points[s];
    Vec3 u = direction(random);
    if (i % 2 == 0) {
      u = cross(u, way);
      u = (1 / length(u)) * u;
    }
    visit(path.points[s] + t * way + ((1 - t) * path.radii[s] + t * path.radii[s + 1]) * u);
  }
}

TEST(path_balls, contain_every_point_of_the_path_and_are_no_farther_from_it_than_they_say) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec3> points;
    std::vector<double> radii;
    for (int i = 0; i < 2 + round % 4; ++i) {
      points.push_back({u(random), u(random), u(random)});
      radii.push_back(round % 3 == 0 ? 0 : round % 3 == 1 ? 0.1 : 0.5 * std::abs(u(random)));
    }
    Path path = path_of(points, radii);
    const Balls outer = balls_along(path, 0.07, PathSide::outer);
    const double error = path.error;
    EXPECT_EQ(path.contains, 1);
    EXPECT_LE(path.spacing, 0.07 * (1 + 1e-12));
    EXPECT_LE(error, 0.035 * (1 + 1e-9));
    for_points_of(path, random, 2000, [&](Vec3 x) { EXPECT_GE(depth(outer, x), -1e-15) << round; });
    // No ball is farther from the path than the error: the ball of the same center in the path is as much
    // smaller.
    Path same = path_of(points, radii);
    const Balls inner = balls_along(same, 0.07, PathSide::inner);
    ASSERT_EQ(inner.size(), outer.size());
    for (std::size_t i = 0; i < inner.size(); ++i) EXPECT_LE(outer.radii[i] - inner.radii[i], error);
    EXPECT_EQ(same.contains, 0);
    EXPECT_EQ(same.error, error);
    for_points_of(path, random, 2000, [&](Vec3 x) { EXPECT_GE(depth(inner, x), -error) << round; });
    EXPECT_EQ(inner.centers.front(), points.front());
    EXPECT_EQ(inner.centers.back(), points.back());
  }
}

TEST(path_balls, of_a_line_have_half_the_spacing_as_radius) {
  Path path = path_of({{0, 0, 0}, {1, 0, 0}}, {0, 0});
  const Balls balls = balls_along(path, 0.25, PathSide::outer);
  ASSERT_EQ(balls.size(), 5u);
  for (const double r : balls.radii) {
    EXPECT_GE(r, 0.125);
    EXPECT_LE(r, 0.125 * (1 + 1e-12));
  }
  // Nothing smaller would do: what is half way between two centers is on both spheres.
  EXPECT_LT(depth(balls, {0.125, 0, 0}), 1e-12);
}

TEST(path_balls, of_a_tube_are_as_large_as_the_chord_asks_for) {
  Path path = path_of({{0, 0, 0}, {1, 0, 0}}, {0.3, 0.3});
  const Balls balls = balls_along(path, 0.25, PathSide::outer);
  for (const double r : balls.radii) EXPECT_NEAR(r, std::sqrt(0.09 + 0.25 * 0.0625), 1e-12);
  EXPECT_NEAR(path.error, std::sqrt(0.09 + 0.25 * 0.0625) - 0.3, 1e-12);
}

TEST(path_balls, where_one_ball_holds_the_next_stay_as_they_are) {
  Path path = path_of({{0, 0, 0}, {0.1, 0, 0}}, {1, 0.5});
  const Balls balls = balls_along(path, 1, PathSide::outer);
  ASSERT_EQ(balls.size(), 2u);
  EXPECT_EQ(balls.radii[0], 1);
  EXPECT_EQ(balls.radii[1], 0.5);
  EXPECT_EQ(path.error, 0);
}

TEST(path_balls, of_one_point_are_one_ball) {
  for (const PathSide side : {PathSide::outer, PathSide::inner}) {
    const PathWithBalls made = path_balls({.file = "path:1 2 3", .width = 0.5, .side = side});
    ASSERT_EQ(made.balls.size(), 1u);
    EXPECT_EQ(made.balls.centers[0], (Vec3{1, 2, 3}));
    EXPECT_NEAR(made.balls.radii[0], 0.25, 1e-14);
    EXPECT_EQ(broken_invariant(made.path), "");
    EXPECT_EQ(made.path.spacing, 0);
  }
}

TEST(path_balls, read_names_widths_and_scales) {
  const Path plain = read("0 0 0\n1 0 0 # there\n\n1 2 0\n");
  EXPECT_EQ(plain.points, (Array<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}}));
  EXPECT_EQ(plain.radii, (Array<double>{0, 0, 0}));
  EXPECT_DOUBLE_EQ(length(plain), 3);
  EXPECT_EQ(read("0,0,0,0.5\n1,0,0,0.25\n").radii, (Array<double>{0.5, 0.25}));
  EXPECT_EQ(read("0 0 0\n1 0 0\n", 0.5).radii, (Array<double>{0.25, 0.25}));
  const Path named = read("time,z,x,y,width\n0,3,1,2,4\n1,6,4,5,2\n", 9, 10);
  EXPECT_EQ(named.points, (Array<Vec3>{{10, 20, 30}, {40, 50, 60}}));
  EXPECT_EQ(named.radii, (Array<double>{20, 10}));
}

/// Remembers warnings.
struct Warnings final : Monitor {
  void warn(const std::string& text) override { texts.push_back(text); }
  std::vector<std::string> texts;
};

TEST(path_balls, take_points_that_repeat_the_one_before_as_one) {
  Warnings warnings;
  const Path path = read_path("0 0 0 1\n0 0 0 2\n0 0 0 1\n1 0 0 1\n0 0 0 1\n", 0, 1, warnings);
  EXPECT_EQ(path.points, (Array<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(path.radii, (Array<double>{2, 1, 1}));
  ASSERT_EQ(warnings.texts.size(), 1u);
  EXPECT_EQ(warnings.texts[0].substr(0, 16), "2 points repeat ");
}

TEST(path_balls, refuse_what_is_no_path_with_the_place) {
  EXPECT_NE(refusal("").find("no point"), std::string::npos);
  EXPECT_NE(refusal("# nothing\n").find("no point"), std::string::npos);
  EXPECT_NE(refusal("0 0 0\n1 nan 0\n").find("line 2"), std::string::npos);
  EXPECT_NE(refusal("0 0 0\n1 inf 0\n").find("line 2"), std::string::npos);
  EXPECT_NE(refusal("0 0 0\n1 0\n").find("point 1"), std::string::npos);
  EXPECT_NE(refusal("0 0 0\n1 0 0 5\n").find("4 numbers instead of 3"), std::string::npos);
  EXPECT_NE(refusal("0 0 0 1 7\n").find("5 numbers"), std::string::npos);
  EXPECT_NE(refusal("0 0 0 -1\n").find("negative radius"), std::string::npos);
  EXPECT_NE(refusal("0 0 0\n3e140 0 0\n").find("1e140"), std::string::npos);
  EXPECT_NE(refusal("a,b,c\n0,0,0\n").find("columns"), std::string::npos);
  EXPECT_NE(refusal("0 0 0\n", -1).find("width"), std::string::npos);
  EXPECT_THROW(path_balls({.file = "path:0 0 0; 1 0 0", .spacing = "0"}), InputError);
  EXPECT_THROW(path_balls({.file = "path:0 0 0; 1 0 0", .spacing = "1e-9"}), InputError);
}

TEST(mirror, is_exact_and_its_own_inverse) {
  const Balls balls{{{1, -2, 0}, {0.1, 1e-300, 3}}, {0, 0.7}, {}, {}};
  const Balls once = mirrored(balls);
  EXPECT_EQ(once.centers, (Array<Vec3>{{-1, 2, 0}, {-0.1, -1e-300, -3}}));
  EXPECT_EQ(once.radii, balls.radii);
  EXPECT_FALSE(std::signbit(once.centers[0].z));
  EXPECT_EQ(mirrored(once).centers, balls.centers);
  EXPECT_EQ(mirrored({}).size(), 0u);
}

}  // namespace
}  // namespace ballflow::geometry
