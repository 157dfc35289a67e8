// Families of shapes that differ in known numbers, in random poses, from their meshes to the scores of a
// model: BALLFLOW_TEST_INSTANCES of each (30 at night).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "individuals.hpp"
#include "prior/shape_prior.hpp"
#include "sample/generate.hpp"
#include "shape_family.hpp"

namespace ballflow::geometry {
namespace {

std::vector<double> mode_scores(const ShapePrior& prior, std::size_t mode) {
  std::vector<double> scores;
  for (std::size_t i = 0; i < prior.instances(); ++i)
    scores.push_back(prior.scores[i * prior.mode_count() + mode]);
  return scores;
}

/// Of the first modes of all variance.
double part_of_variance(const ShapePrior& prior, std::size_t modes) {
  double sum = 0;
  for (std::size_t mode = 0; mode < modes; ++mode) sum += prior.variances[mode];
  return sum / prior.total_variance;
}

/// How well y is explained by scores of the first three modes, which are uncorrelated.
double explained(const ShapePrior& prior, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t mode = 0; mode < 3; ++mode) sum += squared_correlation(mode_scores(prior, mode), y);
  return sum;
}

TEST(known_families, boxes_with_a_bump_that_travels_have_one_mode) {
  const auto n = static_cast<std::size_t>(from_environment("BALLFLOW_TEST_INSTANCES", 6));
  const bool large = n >= 30;
  Random random(1);
  std::vector<double> places;
  std::vector<Individual> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    places.push_back(2.8 + 2.0 * static_cast<double>(i) / static_cast<double>(n - 1));
    boxes.emplace_back(moved(bump_box(places.back()), random_pose(random, 1, 20)), large ? 1000 : 400,
                       large ? 5000 : 800, i);
  }
  const Individual& middle = boxes[n / 2];
  ShapePriorOptions options;
  options.draws = 0;
  // What a bump does reaches about as far as it is wide.
  const MatchOptions matching = {.width = 1, .stiffness = 300};
  const ShapePrior prior =
      shape_prior(matched(boxes, template_of(middle, large ? 200 : 40), middle, matching), {}, options);
  RecordProperty("first", std::to_string(part_of_variance(prior, 1)));
  const double correlation = std::sqrt(squared_correlation(mode_scores(prior, 0), places));
  RecordProperty("correlation", std::to_string(correlation));
  EXPECT_GT(part_of_variance(prior, 1), large ? 0.95 : 0.85);
  EXPECT_GT(correlation, large ? 0.998 : 0.99);
}

TEST(known_families, ellipsoids_have_three_modes_which_tell_their_radii) {
  const auto n = static_cast<std::size_t>(from_environment("BALLFLOW_TEST_INSTANCES", 8));
  const bool large = n >= 30;
  const TriangleMesh sphere = generate({Shape::sphere, large ? 3000 : 800});
  Random random(2);
  std::array<std::vector<double>, 3> radii;
  std::vector<Individual> ellipsoids;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 r{3 + 1.5 * random.unit(), 1.8 + 0.8 * random.unit(), 0.8 + 0.6 * random.unit()};
    radii[0].push_back(r.x);
    radii[1].push_back(r.y);
    radii[2].push_back(r.z);
    std::vector<Vec3> vertices;
    for (const Vec3& v : sphere.vertices) vertices.push_back({r.x * v.x, r.y * v.y, r.z * v.z});
    const TriangleMesh mesh{vertices, sphere.triangles};
    ellipsoids.emplace_back(moved(mesh, random_pose(random, 1, 20)), large ? 1000 : 400, large ? 5000 : 800,
                            i);
  }
  ShapePriorOptions options;
  options.draws = 0;
  const ShapePrior prior = shape_prior(
      matched(ellipsoids, template_of(ellipsoids[0], large ? 200 : 40), ellipsoids[0]), {}, options);
  ASSERT_GE(prior.mode_count(), 4u);
  RecordProperty("three", std::to_string(part_of_variance(prior, 3)));
  RecordProperty("fourth", std::to_string(prior.variances[3] / prior.total_variance));
  EXPECT_GT(part_of_variance(prior, 3), large ? 0.988 : 0.97);
  EXPECT_LT(prior.variances[3] / prior.total_variance, large ? 0.005 : 0.02);
  for (const std::vector<double>& radius : radii) EXPECT_GT(explained(prior, radius), 0.95);
}

}  // namespace
}  // namespace ballflow::geometry
