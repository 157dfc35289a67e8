#include "balls/pole_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "balls/enlarge.hpp"
#include "poles/voronoi_poles.hpp"
#include "search/local_feature_size.hpp"

namespace ballflow::geometry {
namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();

struct Case {
  Balls balls;
  LocalFeatureSize sizes;
};

Case random_case(unsigned seed, double scale = 1, bool mirrored = false, bool reversed = false) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Vec3> centers, points;
  std::vector<double> radii, distances;
  const double side = mirrored ? -scale : scale;
  for (int i = 0; i < 300; ++i) {
    const double x = unit(), y = unit(), z = unit();
    centers.push_back({side * x, scale * y, scale * z});
    radii.push_back(scale * 0.1 * unit());
  }
  for (int i = 0; i < 400; ++i) {
    const double x = unit(), y = unit(), z = unit();
    points.push_back({side * x, scale * y, scale * z});
    distances.push_back(scale * (0.01 + 0.3 * unit() * unit()));
  }
  if (reversed) {
    std::reverse(points.begin(), points.end());
    std::reverse(distances.begin(), distances.end());
  }
  return {{centers, radii, {}, {}}, {points, distances, distances}};
}

std::vector<double> bounds(const Case& c, const PoleBoundOptions& options = {}, double enough = no_bound) {
  return pole_bounds(c.balls, c.sizes, std::vector<double>(c.balls.size(), enough), options);
}

TEST(pole_bound, is_the_smallest_sum_over_all_samples) {
  const Case c = random_case(1);
  for (const PoleBoundConstant constant : {PoleBoundConstant::safe, PoleBoundConstant::thesis}) {
    for (const double r : {0.08, 0.03}) {
      const double lost = constant == PoleBoundConstant::safe ? 2.5604 : 1.2802;
      const double factor = 0.817 - lost * r / (1 - r);
      const auto found = bounds(c, {r, constant});
      for (std::size_t i = 0; i < c.balls.size(); ++i) {
        double least = no_bound;
        for (std::size_t s = 0; s < c.sizes.points.size(); ++s) {
          least = std::min(
              least, distance(c.balls.centers[i], c.sizes.points[s]) + factor * c.sizes.pole_distances[s]);
        }
        EXPECT_NEAR(found[i], least, 1e-11);
        EXPECT_LT(found[i], least);  // strict
      }
    }
  }
}

TEST(pole_bound, has_the_constants_of_the_corrected_and_of_the_printed_lemma) {
  const Case c{{{{0, 0, 0}}, {1}, {}, {}}, {{{1, 0, 0}}, {1}, {1}}};
  EXPECT_NEAR(bounds(c)[0], 1.594, 0.0005);
  EXPECT_NEAR(bounds(c, {0.08, PoleBoundConstant::thesis})[0], 1.706, 0.0005);
}

TEST(pole_bound, needs_not_look_beyond_the_neighbourhood_of_the_lemma) {
  // S' = samples within (1 - r) / (1 - 2.2802 r) times the bound itself: the minimum over them is the bound.
  const double factor = (1 - 0.08) / (1 - 2.2802 * 0.08);
  EXPECT_NEAR(factor, 1.126, 0.001);
  const Case c = random_case(2);
  const auto found = bounds(c);
  for (std::size_t i = 0; i < c.balls.size(); ++i) {
    Case near = c;
    std::vector<Vec3> points;
    std::vector<double> distances;
    for (std::size_t s = 0; s < c.sizes.points.size(); ++s) {
      if (distance(c.balls.centers[i], c.sizes.points[s]) > factor * found[i]) continue;
      points.push_back(c.sizes.points[s]);
      distances.push_back(c.sizes.pole_distances[s]);
    }
    near.sizes = {points, distances, distances};
    EXPECT_EQ(bounds(near)[i], found[i]);
  }
}

TEST(pole_bound, is_infinite_where_less_is_enough) {
  const Case c = random_case(3);
  const auto all = bounds(c), some = bounds(c, {}, 0.1);
  int known = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(some[i], all[i] < 0.1 ? all[i] : no_bound);
    known += all[i] < 0.1 ? 1 : 0;
  }
  EXPECT_GT(known, 10);
  EXPECT_LT(known, 290);
}

TEST(pole_bound, of_permuted_mirrored_and_scaled_samples_is_the_same_or_scaled) {
  const auto found = bounds(random_case(4));
  const auto other = bounds(random_case(4, 1.0 / 1024, true, true));
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(other[i], found[i] / 1024);
}

TEST(pole_bound, refuses_a_density_for_which_nothing_is_proved) {
  for (const double r : {0.0, -1.0, 0.0801, no_bound, std::nan("")}) {
    EXPECT_THROW(bounds(random_case(5), {r}), InputError) << r;
  }
}

TEST(pole_bound, keeps_the_balls_of_enlarge_and_says_which_were_stopped) {
  // A sphere: all inner poles are its centre, D^ is the radius.
  std::mt19937 random(7);
  std::vector<Vec3> points;
  while (points.size() < 500) {
    const auto unit = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    const Vec3 p{unit(), unit(), unit()};
    if (const double d = length(p); d > 0.1 && d < 1) points.push_back(1 / d * p);
  }
  const PointSet sample{points, {}};
  const PoleSet poles = voronoi_poles(sample, {});
  const Balls balls{{{0, 0, 0}, {0.5, 0, 0}}, {1, 0.5}, {}, {}};
  const double edge = bounding_box(sample.points.span()).longest_edge();
  EnlargeOptions options;
  options.mode = EnlargeMode::pole_bound;
  options.epsilon = 25;
  Enlarged grown = enlarge(balls, sample, poles, options);
  EXPECT_EQ(grown.balls.radii[0], 1 + 25. / 100 * edge);
  EXPECT_EQ(grown.growth.stops[0], static_cast<std::uint8_t>(GrowthStop::wish));
  EXPECT_EQ(grown.growth.limits[0], no_bound);
  options.epsilon = 500;
  grown = enlarge(balls, sample, poles, options);
  EXPECT_NEAR(grown.balls.radii[0], 1 + (0.817 - 2.5604 * 0.08 / 0.92), 1e-6);
  EXPECT_EQ(grown.growth.stops[0], static_cast<std::uint8_t>(GrowthStop::poles));
  EXPECT_EQ(grown.growth.limits[0], grown.balls.radii[0]);
  EXPECT_EQ(grown.growth.radii[0], 1);
  EXPECT_EQ(broken_invariant(grown.growth), "");
  EXPECT_EQ(grown.growth.betti_after[0], -1);
}

TEST(pole_bound, of_bad_sets_of_balls_shrinks_nothing) {
  const Case c = random_case(6);
  std::vector<double> wide;
  for (int i = 0; i < 40; ++i) wide.push_back(std::ldexp(1.0, -i));  // 12 orders of magnitude
  const std::vector<Balls> sets = {{},
                                   {{{0.5, 0.5, 0.5}}, {0}, {}, {}},
                                   {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 1, 0}, {}, {}},
                                   {{c.sizes.points[0], c.sizes.points[1]}, {0, 0}, {}, {}},  // at samples
                                   {std::vector<Vec3>(40, Vec3{0.1, 0.2, 0.3}), wide, {}, {}}};
  for (const Balls& balls : sets) {
    const auto found = pole_bounds(balls, c.sizes, std::vector<double>(balls.size(), no_bound), {});
    ASSERT_EQ(found.size(), balls.size());
    for (const double bound : found) EXPECT_TRUE(bound > 0 && bound < no_bound) << bound;
  }
  // Without samples nothing bounds anything.
  EXPECT_EQ(pole_bounds(sets[1], {}, std::vector<double>{5}, {})[0], no_bound);
}

TEST(pole_bound, below_the_radius_leaves_the_ball_as_it_is) {
  const PointSet sample{{{1, 0, 0}, {-1, 0, 0.1}, {0, 1, 0}, {0, -1, 0.2}, {0, 0, 1}, {0, 0.1, -1}}, {}};
  EnlargeOptions options;
  options.mode = EnlargeMode::pole_bound;
  const Balls balls{{{0, 0, 0}}, {9}, {}, {}};
  const Enlarged grown = enlarge(balls, sample, voronoi_poles(sample, {}), options);
  EXPECT_EQ(grown.balls.radii[0], 9);
  EXPECT_EQ(grown.growth.stops[0], static_cast<std::uint8_t>(GrowthStop::poles));
}

}  // namespace
}  // namespace ballflow::geometry
