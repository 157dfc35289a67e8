#include "prior/shape_prior.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "prior/shape_instance.hpp"
#include "shape_family.hpp"

namespace ballflow::geometry {
namespace {

std::vector<double> scores_of_mode(const ShapePrior& prior, std::size_t mode) {
  std::vector<double> scores;
  for (std::size_t i = 0; i < prior.instances(); ++i)
    scores.push_back(prior.scores[i * prior.mode_count() + mode]);
  return scores;
}

std::vector<double> scores_of_instance(const ShapePrior& prior, std::size_t i) {
  const auto first = prior.scores.begin() + static_cast<std::ptrdiff_t>(i * prior.mode_count());
  return {first, first + static_cast<std::ptrdiff_t>(prior.mode_count())};
}

Vec3 applied(const std::array<double, 12>& t, Vec3 p) {
  return {t[0] * p.x + t[1] * p.y + t[2] * p.z + t[3], t[4] * p.x + t[5] * p.y + t[6] * p.z + t[7],
          t[8] * p.x + t[9] * p.y + t[10] * p.z + t[11]};
}

/// Everything but what lists instances.
void expect_same_model(const ShapePrior& a, const ShapePrior& b) {
  EXPECT_EQ(a.centers, b.centers);
  EXPECT_EQ(a.radii, b.radii);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.modes, b.modes);
  EXPECT_EQ(a.point_modes, b.point_modes);
  EXPECT_EQ(a.variances, b.variances);
  EXPECT_EQ(a.generalization, b.generalization);
  EXPECT_EQ(a.generalization_deviation, b.generalization_deviation);
  EXPECT_EQ(a.specificity, b.specificity);
  EXPECT_EQ(a.specificity_deviation, b.specificity_deviation);
}

TEST(shape_prior, finds_the_two_numbers_that_its_instances_differ_in) {
  const Family known = family(12);
  const ShapePrior prior = shape_prior(known.members, {});
  ASSERT_EQ(broken_invariant(prior), "");
  ASSERT_GE(prior.mode_count(), 2u);
  // Turning the mean of logarithms and the superpositions bend the two straight lines a little.
  EXPECT_GT(prior.variances[0] + prior.variances[1], 0.9999 * prior.total_variance);
  EXPECT_GT(squared_correlation(scores_of_mode(prior, 0), known.lengths) +
                squared_correlation(scores_of_mode(prior, 1), known.lengths),
            0.9);
  for (std::size_t mode = 0; mode < 2; ++mode) {
    const std::vector<double> scores = scores_of_mode(prior, mode);
    double sum = 0, squares = 0;
    for (const double score : scores) sum += score, squares += score * score;
    EXPECT_NEAR(sum, 0, 1e-9);
    EXPECT_NEAR(squares / 11, 1, 1e-9);
    EXPECT_GT(std::abs(*std::max_element(scores.begin(), scores.end())),
              std::abs(*std::min_element(scores.begin(), scores.end())));
  }
}

TEST(shape_prior, an_instance_is_the_mean_and_its_scores) {
  // But for modes of a millionth of the first one, which are left out.
  const Family known = family(5);
  const ShapePrior prior = shape_prior(known.members, {});
  for (std::size_t i = 0; i < known.members.size(); ++i) {
    const std::vector<double> scores = scores_of_instance(prior, i);
    const Balls balls = shape_instance(prior, scores);
    const PointSet points = instance_points(prior, scores);
    for (std::size_t ball = 0; ball < balls.size(); ++ball) {
      EXPECT_LT(distance(balls.centers[ball], applied(prior.poses[i], known.members[i].centers[ball])), 1e-6);
      EXPECT_NEAR(balls.radii[ball], known.members[i].radii[ball], 1e-6);
    }
    for (std::size_t j = 0; j < points.points.size(); ++j)
      EXPECT_LT(distance(points.points[j], applied(prior.poses[i], known.members[i].points[j])), 1e-6);
  }
}

TEST(shape_prior, variances_are_mean_squared_displacements_in_the_metric) {
  ShapePriorOptions options;
  options.point_share = 0.25;
  options.radius_weight = 2;
  options.along = 0.2;
  const Family known = family(6);
  const ShapePrior prior = shape_prior(known.members, {}, options);
  double radius = 0, total = 0;
  for (const MatchedBalls& member : known.members) {
    for (const double r : member.radii) radius += r / static_cast<double>(6 * member.size());
  }
  EXPECT_NEAR(prior.radius_unit, 2 * radius, 1e-12);
  for (std::size_t i = 0; i < 6; ++i) {
    const MatchedBalls& member = known.members[i];
    double balls = 0, points = 0;
    for (std::size_t b = 0; b < member.size(); ++b) {
      const double growth = prior.radius_unit * std::log(member.radii[b] / prior.radii[b]);
      balls +=
          squared_distance(applied(prior.poses[i], member.centers[b]), prior.centers[b]) + growth * growth;
    }
    for (std::size_t j = 0; j < member.points.size(); ++j) {
      const Vec3 moved_by = applied(prior.poses[i], member.points[j]) - prior.points[j];
      const double off = dot(moved_by, prior.normals[j]);
      points += off * off + 0.2 * (squared_length(moved_by) - off * off);
    }
    const double squared = 0.75 * balls / static_cast<double>(member.size()) +
                           0.25 * points / static_cast<double>(member.points.size());
    EXPECT_NEAR(prior.distances[i] * prior.distances[i], squared, 1e-12);
    total += squared / 5;
  }
  EXPECT_NEAR(prior.total_variance, total, 1e-12);
}

TEST(shape_prior, does_not_depend_on_the_order_of_instances_and_on_threads) {
  const Family known = family(7);
  std::vector<MatchedBalls> shuffled;
  const std::vector<std::size_t> order = {4, 0, 6, 2, 5, 1, 3};
  for (const std::size_t i : order) shuffled.push_back(known.members[i]);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ShapePrior prior = shape_prior(known.members, {});
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
  const ShapePrior again = shape_prior(shuffled, {});
  expect_same_model(prior, again);
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(scores_of_instance(again, i), scores_of_instance(prior, order[i]));
    EXPECT_EQ(again.poses[i], prior.poses[order[i]]);
    EXPECT_EQ(again.distances[i], prior.distances[order[i]]);
  }
}

TEST(shape_prior, scores_stay_where_instances_are_turned_shifted_and_scaled) {
  const Family known = family(8);
  Random random(3);
  for (const bool scale : {false, true}) {
    ShapePriorOptions options;
    options.scale = scale;
    options.draws = 0;
    std::vector<MatchedBalls> elsewhere;
    // One factor for all where sizes count, else one for each.
    for (const MatchedBalls& member : known.members)
      elsewhere.push_back(moved(member, random_pose(random, scale ? 0.5 + random.unit() : 1.7, 30)));
    const ShapePrior a = shape_prior(known.members, {}, options), b = shape_prior(elsewhere, {}, options);
    // What rounding leaves of modes that do not exist differs.
    for (std::size_t mode = 0; mode < 2; ++mode) {
      for (std::size_t i = 0; i < known.members.size(); ++i)
        EXPECT_NEAR(scores_of_mode(a, mode)[i], scores_of_mode(b, mode)[i], 1e-6) << scale << mode;
      EXPECT_NEAR(b.variances[mode] / b.total_variance, a.variances[mode] / a.total_variance, 1e-6);
    }
  }
}

TEST(shape_prior, knows_an_instance_that_it_has_not_seen_and_little_else) {
  const Family known = family(10);
  const ShapePrior prior = shape_prior(known.members, {});
  ASSERT_GE(prior.generalization.size(), 3u);
  EXPECT_EQ(prior.measure, static_cast<std::uint8_t>(SurfaceMeasure::planes));
  EXPECT_GT(prior.generalization[0], 0.05);
  EXPECT_LT(prior.generalization[2], 0.05 * prior.generalization[0]);
  // Two numbers in a square of known size: ten of them leave few far from all.
  EXPECT_GT(prior.specificity[0], 0);
  EXPECT_LT(prior.specificity[1], 2 * prior.generalization[0]);
  for (const double deviation : prior.specificity_deviation) EXPECT_GT(deviation, 0);
}

TEST(shape_prior, an_instance_left_out_is_as_far_from_the_mean_of_the_others_as_the_formula_says) {
  // Six balls on the axes: nothing turns or shifts when two of them move apart.
  std::vector<MatchedBalls> crosses;
  for (const double x : {3.0, 3.3, 3.6}) {
    MatchedBalls cross;
    cross.centers = {{x, 0, 0}, {-x, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 1}, {0, 0, -1}};
    cross.radii = std::vector<double>(6, 1.0);
    crosses.push_back(cross);
  }
  const ShapePrior prior = shape_prior(crosses, {});
  EXPECT_EQ(prior.measure, static_cast<std::uint8_t>(SurfaceMeasure::labels));
  // Two balls of six move by .45, 0 and .45.
  ASSERT_GE(prior.generalization.size(), 2u);
  EXPECT_NEAR(prior.generalization[0], 0.1, 1e-12);
  EXPECT_NEAR(prior.generalization_deviation[0], 0.15 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(prior.generalization[1], 0, 1e-12);
  // Half of the differences 0.3 and 0.6 of two of six balls, squared.
  EXPECT_NEAR(prior.total_variance, (2.0 / 6) * (0.09 + 0.09) / 2, 1e-12);
}

TEST(shape_prior, refuses_what_is_no_family) {
  const Family known = family(3);
  const auto message = [](const std::vector<MatchedBalls>& members, const std::vector<TriangleMesh>& meshes) {
    try {
      shape_prior(members, meshes);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(message({known.members[0]}, {}).find("1 instance does not"), std::string::npos);
  EXPECT_NE(message({known.members[0], known.members[0]}, {}).find("all the same shape"), std::string::npos);
  EXPECT_NE(
      message({known.members[0], family_member(0, 0, 29)}, {}).find("instance 1 (of 0 to 1) has 29 balls"),
      std::string::npos);
  ShapePose huge;
  huge.scale = 1e120;
  EXPECT_NE(message({known.members[0], known.members[1], moved(known.members[2], huge)}, {})
                .find("instance 2 (of 0 to 2) has coordinates beyond 1e100"),
            std::string::npos);
  EXPECT_NE(message(known.members, {TriangleMesh{}}).find("1 meshes for 3 instances"), std::string::npos);
}

TEST(shape_prior, warns_of_twins_of_mirror_images_and_of_other_shapes) {
  const Family known = family(6);
  std::vector<MatchedBalls> members = known.members;
  {
    Warnings warnings;
    shape_prior(members, {}, {}, warnings);
    EXPECT_EQ(warnings.text, "");
  }
  members.push_back(moved(members[2], ShapePose{}));
  {
    Warnings warnings;
    shape_prior(members, {}, {}, warnings);
    EXPECT_TRUE(says(warnings, "instances 2 and 6 are the same shape"));
  }
  members[6] = family_member(2, 0.5);
  {
    Warnings warnings;
    shape_prior(members, {}, {}, warnings);
    EXPECT_TRUE(says(warnings, "instance 6 (of 0 to 6) is "));
  }
  ShapePose mirror;
  mirror.rotation = {-1, 0, 0, 0, 1, 0, 0, 0, 1};
  mirror.mirrored = 1;
  members[6] = moved(family_member(0.05, 0.02), mirror);
  {
    Warnings warnings;
    shape_prior(members, {}, {}, warnings);
    EXPECT_TRUE(says(warnings, "as its mirror image"));
  }
  // Matched as a mirror image it is one of them.
  members[6].mirrored = 1;
  {
    Warnings warnings;
    const ShapePrior prior = shape_prior(members, {}, {}, warnings);
    EXPECT_FALSE(says(warnings, "mirror")) << warnings.text;
    const auto& pose = prior.poses[6];
    EXPECT_NEAR(distance(applied(pose, members[6].centers[0]),
                         shape_instance(prior, scores_of_instance(prior, 6)).centers[0]),
                0, 1e-6);  // modes of less are left out
  }
}

}  // namespace
}  // namespace ballflow::geometry
