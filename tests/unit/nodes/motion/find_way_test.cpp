#include "motion/find_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "power/alpha_shape.hpp"
#include "power/power_diagram.hpp"

namespace ballflow::geometry {
namespace {

struct Number {
  double x, y, z, r;
};
Balls obstacles_of(const std::vector<Number>& numbers) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Number& b : numbers) {
    centers.push_back({b.x, b.y, b.z});
    radii.push_back(b.r);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

Way way_between(const Balls& balls, Vec3 start, Vec3 goal, const MinkowskiReport* report = nullptr) {
  const PowerDiagram diagram = power_diagram(balls, {}, no_monitor());
  const Way way = find_way(balls, diagram, start, goal, no_monitor(), report);
  EXPECT_EQ(broken_invariant(way), "");
  return way;
}

double gap(const Balls& balls, Vec3 p) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < balls.size(); ++i)
    least = std::min(least, distance(p, balls.centers[i]) - balls.radii[i]);
  return least;
}

/// It is a polyline from start to goal of which no sample is in a ball, or nearer than it says.
void expect_free(const Balls& balls, const Way& way) {
  ASSERT_EQ(way.said(), WayAnswer::way);
  ASSERT_GE(way.points.size(), 2u) << describe(way);
  for (std::size_t i = 1; i < way.points.size(); ++i) {
    for (int k = 0; k <= 50; ++k) {
      const double t = k / 50.0;
      const double g = gap(balls, (1 - t) * way.points[i - 1] + t * way.points[i]);
      EXPECT_GT(g, 0);
      EXPECT_GE(g, way.clearance - 1e-12);
    }
  }
  for (std::size_t i = 0; i < way.points.size(); ++i)
    EXPECT_NEAR(way.clearances[i], gap(balls, way.points[i]), 1e-12);
}

/// Balls all over a sphere, so large that they leave its inside as a void; without those near the pole if it
/// is open.
Balls shell(bool open) {
  std::vector<Number> numbers;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i) {  // a spiral
    const double z = 1 - (2.0 * i + 1) / n, s = std::sqrt(1 - z * z), angle = 2.399963229728653 * i;
    if (!open || z < 0.8) numbers.push_back({s * std::cos(angle), s * std::sin(angle), z, 0.15});
  }
  return obstacles_of(numbers);
}

TEST(find_way, out_of_a_shell_needs_a_hole) {
  const Way none = way_between(shell(false), {0, 0, 0}, {3, 0, 0});
  EXPECT_EQ(none.said(), WayAnswer::none);
  EXPECT_EQ(none.components, 2);
  EXPECT_EQ(none.start_component, 1);
  EXPECT_EQ(none.goal_component, 0);
  EXPECT_EQ(none.points.size(), 0u);
  expect_free(shell(false), way_between(shell(false), {0, 0, 0}, {0.3, -0.4, 0.2}));
  expect_free(shell(true), way_between(shell(true), {0, 0, 0}, {0, 0, -3}));
}

TEST(find_way, goes_around_what_is_between) {
  for (const auto& numbers :
       {std::vector<Number>{{0, 0, 0, 1}}, std::vector<Number>{{0, 0, 0, 1}, {0, 1, 0, 1}},
        std::vector<Number>{{0, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}},
        std::vector<Number>{{0, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {0, -1, -1, 1}},
        std::vector<Number>{{0, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {0.5, -1, -1, 1}},
        std::vector<Number>{{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 0.5}}}) {
    const Balls balls = obstacles_of(numbers);
    const Way way = way_between(balls, {-2.5, 0.1, 0}, {2.5, 0, 0});
    expect_free(balls, way);
    EXPECT_GE(length(way), 5);
    expect_free(balls, way_between(balls, {-1.5, 0.1, 0}, {9, 0, 0}));
    expect_free(balls, way_between(balls, {20, 0, 0}, {-20, 0.25, 0}));
  }
}

TEST(find_way, is_straight_where_nothing_is_between) {
  const Balls balls = obstacles_of({{0, 0, 0, 1}, {5, 0, 0, 1}, {0, 5, 0, 1}, {0, 0, 5, 1}, {5, 5, 5, 1}});
  const Way way = way_between(balls, {2.5, 0, 0}, {2.5, 1, 0});
  expect_free(balls, way);
  EXPECT_EQ(way.points.size(), 2u);
  expect_free(balls, way_between(balls, {2.5, 0, 0}, {2.5, 0, 0}));
}

TEST(find_way, names_the_ball_that_start_or_goal_is_in) {
  const Balls balls = obstacles_of({{0, 0, 0, 2}, {6, 0, 0, 1}, {0, 1, 0, 1.5}});
  const Way start = way_between(balls, {0, 0.5, 0}, {3, 3, 3});
  EXPECT_EQ(start.said(), WayAnswer::start_inside);
  EXPECT_EQ(start.start_ball, 0);
  EXPECT_EQ(start.goal_component, 0);
  EXPECT_EQ(way_between(balls, {3, 3, 3}, {6, 0.5, 0}).goal_ball, 1);
  EXPECT_EQ(way_between(balls, {0, 0, 0}, {6, 0.5, 0}).said(), WayAnswer::both_inside);
  // Touching is inside, next to it is not.
  EXPECT_EQ(way_between(balls, {7, 0, 0}, {9, 0, 0}).said(), WayAnswer::start_inside);
  const Way beside = way_between(balls, {std::nextafter(7, 8), 0, 0}, {9, 0, 0});
  EXPECT_EQ(beside.said(), WayAnswer::way);
  EXPECT_LT(beside.clearance, 1e-14);
}

TEST(find_way, of_balls_that_touch_is_closed_and_of_balls_apart_is_open) {
  // Six balls around the origin that leave a cube's worth of room, and eight in the corners. With radius
  // sqrt(2) / 2 and more the twelve on the edges close it; exactly touching spheres leave gaps between three
  // of them.
  std::vector<Number> cage;
  for (const int x : {-1, 0, 1}) {
    for (const int y : {-1, 0, 1}) {
      for (const int z : {-1, 0, 1}) {
        if (x != 0 || y != 0 || z != 0) cage.push_back({1.0 * x, 1.0 * y, 1.0 * z, 0.75});
      }
    }
  }
  EXPECT_EQ(way_between(obstacles_of(cage), {0, 0, 0}, {4, 0, 0}).said(), WayAnswer::none);
  for (Number& b : cage) b.r = 0.5;  // touching: windows between four of them
  const Way open = way_between(obstacles_of(cage), {0, 0, 0}, {4, 0.5, 0.25});
  expect_free(obstacles_of(cage), open);
}

/// Whether a lattice joins two of its points, by steps between points side by side that meet no ball. What it
/// joins is joined; gaps that are narrower than its steps it may miss.
class FreeLattice {
 public:
  static constexpr int n = 25;
  explicit FreeLattice(const Balls& balls) : free_(n * n * n), parent_(n * n * n) {
    for (int x = 0; x < n; ++x) {
      for (int y = 0; y < n; ++y) {
        for (int z = 0; z < n; ++z) {
          const std::size_t here = number(x, y, z);
          parent_[here] = here;
          free_[here] = gap(balls, point(x, y, z)) > 0;
          if (x > 0) join(balls, here, {x, y, z}, {x - 1, y, z});
          if (y > 0) join(balls, here, {x, y, z}, {x, y - 1, z});
          if (z > 0) join(balls, here, {x, y, z}, {x, y, z - 1});
        }
      }
    }
  }
  static Vec3 point(int x, int y, int z) {
    const auto at = [](int i) { return 3.0 * i / (n - 1) - 1.5; };
    return {at(x), at(y), at(z)};
  }
  bool free(int x, int y, int z) const { return free_[number(x, y, z)]; }
  bool joined(std::array<int, 3> p, std::array<int, 3> q) const {
    return root(number(p[0], p[1], p[2])) == root(number(q[0], q[1], q[2]));
  }

 private:
  static std::size_t number(int x, int y, int z) { return static_cast<std::size_t>((x * n + y) * n + z); }
  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(const Balls& balls, std::size_t here, std::array<int, 3> p, std::array<int, 3> q) {
    const std::size_t there = number(q[0], q[1], q[2]);
    if (!free_[here] || !free_[there]) return;
    const Vec3 a = point(p[0], p[1], p[2]), way = point(q[0], q[1], q[2]) - a;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const Vec3 arm = balls.centers[i] - a;
      const double t = std::clamp(dot(arm, way) / dot(way, way), 0.0, 1.0);
      if (length(arm - t * way) <= balls.radii[i] + 1e-12) return;
    }
    parent_[root(here)] = root(there);
  }
  std::vector<bool> free_;
  std::vector<std::size_t> parent_;
};

TEST(find_way, finds_what_a_lattice_finds_and_parts_what_voids_part) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> u(0, 1);
  int ways = 0, none = 0, found = 0;
  for (int round = 0; round < 20; ++round) {
    // A shell with more or fewer holes, and some balls in and around it.
    Balls balls = shell(false);
    std::vector<Vec3> centers(balls.centers.begin(), balls.centers.end());
    std::vector<double> radii;
    for (std::size_t i = 0; i < centers.size(); ++i)
      radii.push_back(0.145 - 0.006 * round * u(random) * u(random));
    for (int i = 0; i < 40; ++i) {
      centers.push_back({3 * u(random) - 1.5, 3 * u(random) - 1.5, 3 * u(random) - 1.5});
      radii.push_back(0.2 * u(random));
    }
    balls = {centers, radii, {}, {}};
    const PowerDiagram diagram = power_diagram(balls, {}, no_monitor());
    const std::int64_t cavities = alpha_shape(diagram, no_monitor()).betti[2];
    const FreeLattice lattice(balls);
    for (const std::array<int, 3> p : {std::array{12, 12, 12}, std::array{12, 14, 11}, std::array{1, 1, 1}}) {
      for (const std::array<int, 3> q : {std::array{12, 10, 13}, std::array{23, 20, 2}}) {
        if (!lattice.free(p[0], p[1], p[2]) || !lattice.free(q[0], q[1], q[2])) continue;
        const Way way = find_way(balls, diagram, FreeLattice::point(p[0], p[1], p[2]),
                                 FreeLattice::point(q[0], q[1], q[2]), no_monitor());
        EXPECT_EQ(broken_invariant(way), "");
        EXPECT_EQ(way.components, 1 + cavities);
        if (lattice.joined(p, q)) {
          ++found;
          EXPECT_EQ(way.said(), WayAnswer::way);
        }
        if (way.said() == WayAnswer::way) {
          ++ways;
          expect_free(balls, way);
        } else {
          ++none;
        }
      }
    }
  }
  EXPECT_GT(ways, 25);
  EXPECT_GT(found, 20);
  EXPECT_GT(none, 10);
}

TEST(find_way, is_as_proven_as_the_sum) {
  const Balls balls = shell(false);
  MinkowskiReport contains, inside;
  contains.rounded = static_cast<std::uint8_t>(SumsRounded::outwards);
  contains.a_encloses = contains.b_encloses = static_cast<std::uint8_t>(SideProof::proven);
  inside.rounded = static_cast<std::uint8_t>(SumsRounded::inwards);
  inside.a_inside = inside.b_inside = static_cast<std::uint8_t>(SideProof::proven);
  ASSERT_TRUE(contains.contains());
  ASSERT_TRUE(inside.inside());
  EXPECT_NE(describe(way_between(balls, {2, 0, 0}, {3, 0, 0}, &contains)).find("proven"), std::string::npos);
  EXPECT_EQ(describe(way_between(balls, {0, 0, 0}, {3, 0, 0}, &contains)).find("proven"), std::string::npos);
  EXPECT_NE(describe(way_between(balls, {0, 0, 0}, {3, 0, 0}, &inside)).find("proven"), std::string::npos);
  EXPECT_EQ(describe(way_between(balls, {2, 0, 0}, {3, 0, 0}, &inside)).find("proven"), std::string::npos);
  EXPECT_NE(describe(way_between(balls, {1, 0, 0}, {3, 0, 0}, &inside)).find("proven to be a collision"),
            std::string::npos);
}

TEST(find_way, refuses_no_balls_other_diagrams_and_points_that_are_none) {
  const Balls one = obstacles_of({{0, 0, 0, 1}}), other = obstacles_of({{0, 0, 0, 2}});
  EXPECT_THROW(way_between({}, {}, {}), InputError);
  const PowerDiagram diagram = power_diagram(other, {}, no_monitor());
  EXPECT_THROW(find_way(one, diagram, {2, 0, 0}, {3, 0, 0}, no_monitor()), InputError);
  EXPECT_THROW(way_between(one, {NAN, 0, 0}, {3, 0, 0}), InputError);
  EXPECT_EQ(parse_point(" 1,-2.5 \t +3e2", "start"), (Vec3{1, -2.5, 300}));
  for (const char* text : {"", "1 2", "1 2 3 4", "1 2 x", "1 2 nan", "1 2 inf", "1 2 3x", "1;2;3"})
    EXPECT_THROW(parse_point(text, "start"), InputError) << text;
}

}  // namespace
}  // namespace ballflow::geometry
