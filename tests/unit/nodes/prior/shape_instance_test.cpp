#include "prior/shape_instance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "prior/shape_prior.hpp"
#include "shape_family.hpp"

namespace ballflow::geometry {
namespace {

TEST(shape_instance, reads_scores_with_commas_and_as_a_list) {
  EXPECT_EQ(parse_scores("2,-1"), (std::vector<double>{2, -1}));
  EXPECT_EQ(parse_scores(" [2, -1.5e-1] "), (std::vector<double>{2, -0.15}));
  EXPECT_EQ(parse_scores(R"(["2","-1"])"), (std::vector<double>{2, -1}));
  EXPECT_TRUE(parse_scores("").empty());
  EXPECT_TRUE(parse_scores("[]").empty());
  for (const char* wrong : {"2,", ",2", "2;1", "[2", "nan", "inf", "1e999", "two", "1,,2"})
    EXPECT_THROW(parse_scores(wrong), InputError) << wrong;
}

TEST(shape_instance, is_the_mean_plus_standard_deviations) {
  const ShapePrior prior = shape_prior(family(6).members, {});
  const std::vector<double> scores = {1.5, -0.5};
  const Balls mean = shape_instance(prior, {}), balls = shape_instance(prior, scores);
  EXPECT_EQ(mean.centers, prior.centers);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const auto &first = prior.modes[i], &second = prior.modes[prior.balls() + i];
    EXPECT_NEAR(balls.centers[i].y, prior.centers[i].y + 1.5 * first[1] - 0.5 * second[1], 1e-12);
    EXPECT_NEAR(std::log(balls.radii[i] / prior.radii[i]), 1.5 * first[3] - 0.5 * second[3], 1e-12);
  }
  const PointSet points = instance_points(prior, scores);
  ASSERT_EQ(points.points.size(), prior.points.size());
  EXPECT_NEAR(
      points.points[5].z,
      prior.points[5].z + 1.5 * prior.point_modes[5].z - 0.5 * prior.point_modes[prior.points.size() + 5].z,
      1e-12);
}

TEST(shape_instance, refuses_more_scores_than_modes_and_what_leaves_the_numbers) {
  const ShapePrior prior = shape_prior(family(3).members, {});
  EXPECT_THROW(shape_instance(prior, std::vector<double>(prior.mode_count() + 1, 0.0)), InputError);
  EXPECT_THROW(shape_instance(prior, std::vector<double>{1e300}), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
