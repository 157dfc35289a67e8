#include "balls/enlarge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

const PointSet two_points{{{-1, 0, 2}, {1, 8, 3}}, {}};  // longest edge of the box: 8

Balls enlarge(const Balls& balls, const PointSet& points, const EnlargeOptions& options) {
  return geometry::enlarge(balls, points, {}, options).balls;
}

Balls sample_balls() {
  return {{{0, 0, 0}, {1, 2, 3}, {4, 5, 6}}, {0, 1, 2.5}, {0, 2, 2, 5}, {3, 9, 0, 1, 7}};
}

void expect_same_but_radii(const Balls& grown, const Balls& balls) {
  EXPECT_EQ(grown.centers, balls.centers);
  EXPECT_EQ(grown.defining_offsets, balls.defining_offsets);
  EXPECT_EQ(grown.defining_samples, balls.defining_samples);
  EXPECT_EQ(broken_invariant(grown), "");
}

std::string message(const Balls& balls, const PointSet& points, const EnlargeOptions& options) {
  try {
    enlarge(balls, points, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(enlarge, additive_epsilon_is_percent_of_the_longest_edge_of_the_box) {
  const Balls balls = sample_balls();
  const Balls grown = enlarge(balls, two_points, {.mode = EnlargeMode::additive, .epsilon = 25});
  EXPECT_EQ(grown.radii, (Array<double>{2, 3, 4.5}));
  expect_same_but_radii(grown, balls);
}

TEST(enlarge, default_is_three_thousandths_of_the_longest_edge) {
  const Balls grown = enlarge(sample_balls(), two_points, {});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(grown.radii[i] - sample_balls().radii[i], 0.024, 1e-15);
}

TEST(enlarge, absolute_epsilon_is_in_model_units_and_needs_no_sample) {
  const Balls grown = enlarge(sample_balls(), PointSet{}, {.mode = EnlargeMode::absolute, .epsilon = 0.5});
  EXPECT_EQ(grown.radii, (Array<double>{0.5, 1.5, 3}));
  expect_same_but_radii(grown, sample_balls());
}

TEST(enlarge, multiplicative_keeps_balls_of_radius_zero) {
  const Balls grown = enlarge(sample_balls(), PointSet{},
                              {.mode = EnlargeMode::multiplicative, .epsilon = -7, .factor = 1.5});
  EXPECT_EQ(grown.radii, (Array<double>{0, 1.5, 3.75}));
  expect_same_but_radii(grown, sample_balls());
}

TEST(enlarge, by_nothing_returns_the_input) {
  EXPECT_EQ(enlarge(sample_balls(), two_points, {.epsilon = 0}).radii, sample_balls().radii);
  EXPECT_EQ(enlarge(sample_balls(), two_points, {.mode = EnlargeMode::absolute, .epsilon = 0}).radii,
            sample_balls().radii);
  EXPECT_EQ(enlarge(sample_balls(), two_points, {.mode = EnlargeMode::multiplicative, .factor = 1}).radii,
            sample_balls().radii);
}

TEST(enlarge, never_shrinks_a_radius_by_rounding) {
  std::vector<Vec3> centers(1000);
  std::vector<double> radii;
  for (int i = 0; i < 1000; ++i) radii.push_back(std::sqrt(i) * std::ldexp(1.0, i % 60 - 30));
  const Balls balls{centers, radii, {}, {}};
  for (const EnlargeMode mode : {EnlargeMode::additive, EnlargeMode::absolute, EnlargeMode::multiplicative}) {
    const Balls grown = enlarge(balls, two_points, {.mode = mode, .epsilon = 1e-13, .factor = 1 + 0x1p-52});
    for (std::size_t i = 0; i < radii.size(); ++i) ASSERT_GE(grown.radii[i], radii[i]);
  }
}

TEST(enlarge, accepts_no_ball) { EXPECT_EQ(enlarge({}, two_points, {}).size(), 0u); }

TEST(enlarge, names_what_is_wrong) {
  const Balls balls = sample_balls();
  EXPECT_NE(message(balls, PointSet{}, {}).find("needs the sample"), std::string::npos);
  EXPECT_NE(message(balls, two_points, {.epsilon = -1}).find("epsilon is -1"), std::string::npos);
  EXPECT_NE(message(balls, two_points, {.epsilon = std::nan("")}).find("epsilon is"), std::string::npos);
  EXPECT_NE(
      message(balls, two_points, {.mode = EnlargeMode::multiplicative, .factor = 0.5}).find("factor is 0.5"),
      std::string::npos);
  const double most = std::numeric_limits<double>::max();
  EXPECT_NE(message({{{0, 0, 0}, {1, 0, 0}}, {0, most}, {}, {}}, two_points,
                    {.mode = EnlargeMode::multiplicative, .factor = 2})
                .find("ball 1"),
            std::string::npos);
  EXPECT_NE(message({{{0, 0, 0}}, {-3}, {}, {}}, two_points, {}).find("ball 0"), std::string::npos);
}

TEST(enlarge, modes_with_bounds_say_what_input_is_missing) {
  EXPECT_NE(message(sample_balls(), two_points, {.mode = EnlargeMode::pole_bound}).find("needs the poles"),
            std::string::npos);
  EXPECT_NE(message(sample_balls(), {}, {.mode = EnlargeMode::power_diagram})
                .find("mode power_diagram needs the sample"),
            std::string::npos);
}

TEST(enlarge, without_bounds_says_that_every_wish_was_granted) {
  const Growth growth = geometry::enlarge(sample_balls(), two_points, {}, {}).growth;
  EXPECT_EQ(broken_invariant(growth), "");
  EXPECT_EQ(growth.radii, sample_balls().radii);
  EXPECT_EQ(growth.stops, (Array<std::uint8_t>{0, 0, 0}));
  EXPECT_EQ(growth.betti_before[0], -1);
}

TEST(enlarge, by_the_power_diagram_reports_the_topology_it_kept) {
  const Balls apart{{{0, 0, 0}, {4, 0, 0}}, {1, 1}, {0, 1, 2}, {0, 1}};
  EnlargeOptions options;
  options.mode = EnlargeMode::power_diagram;
  options.epsilon = 50;  // of 8
  const Enlarged grown = geometry::enlarge(apart, two_points, {}, options);
  expect_same_but_radii(grown.balls, apart);
  EXPECT_NEAR(grown.balls.radii[0], 2, 1e-9);
  EXPECT_LT(grown.balls.radii[0], 2);
  EXPECT_EQ(grown.growth.stops, (Array<std::uint8_t>{2, 2}));
  EXPECT_EQ(grown.growth.betti_before, (std::array<std::int64_t, 3>{2, 0, 0}));
  EXPECT_EQ(grown.growth.betti_after, (std::array<std::int64_t, 3>{2, 0, 0}));
}

TEST(growth, reports_broken_invariants) {
  const Growth good{{{0, 0, 0}}, {1}, {2}, {2}, {1}};
  ASSERT_EQ(broken_invariant(good), "");
  Growth g = good;
  g.grown_radii = {0.5};
  EXPECT_NE(broken_invariant(g).find("ball 0"), std::string::npos);
  g = good;
  g.stops = {4};
  EXPECT_NE(broken_invariant(g).find("reason 4"), std::string::npos);
  g = good;
  g.limits = {std::nan("")};
  EXPECT_NE(broken_invariant(g).find("limit"), std::string::npos);
  g = good;
  g.limits = {};
  EXPECT_NE(broken_invariant(g), "");
}

TEST(balls, report_broken_invariants) {
  ASSERT_EQ(broken_invariant(sample_balls()), "");
  Balls b = sample_balls();
  b.radii = {0, 1};
  EXPECT_NE(broken_invariant(b), "");
  b = sample_balls();
  b.radii = {0, 1, std::nan("")};
  EXPECT_NE(broken_invariant(b).find("ball 2"), std::string::npos);
  b = sample_balls();
  b.centers = {{0, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}, {0, 0, 0}};
  EXPECT_NE(broken_invariant(b).find("ball 1"), std::string::npos);
  b = sample_balls();
  b.defining_offsets = {0, 2, 5};
  EXPECT_NE(broken_invariant(b), "");
  b = sample_balls();
  b.defining_offsets = {0, 4, 2, 5};
  EXPECT_NE(broken_invariant(b).find("ball 1"), std::string::npos);
  b = sample_balls();
  b.defining_offsets = {0, 2, 2, 6};
  EXPECT_NE(broken_invariant(b), "");
  b = sample_balls();
  b.defining_offsets = {};
  EXPECT_NE(broken_invariant(b), "");
  b = sample_balls();
  b.defining_samples = {3, 9, 0, 0, 7};
  EXPECT_NE(broken_invariant(b).find("ball 2"), std::string::npos);
  b = sample_balls();
  b.defining_samples = {-1, 9, 0, 1, 7};
  EXPECT_NE(broken_invariant(b).find("ball 0"), std::string::npos);
}

TEST(enlarge, takes_epsilon_from_a_search_where_the_mode_uses_it) {
  Bisection search;
  search.value = 0.75;
  EXPECT_EQ(searched({}, search).epsilon, 0.75);
  EXPECT_THROW(searched({.mode = EnlargeMode::multiplicative}, search), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
