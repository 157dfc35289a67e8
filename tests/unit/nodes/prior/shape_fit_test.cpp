#include "prior/shape_fit.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "prior/shape_instance.hpp"
#include "prior/shape_prior.hpp"
#include "shape_family.hpp"

namespace ballflow::geometry {
namespace {

const ShapePrior& model() {
  static const ShapePrior prior = [] {
    ShapePriorOptions options;
    options.modes = 2;
    return shape_prior(family(12).members, {}, options);
  }();
  return prior;
}

/// The surface points of an instance of the model with x above `from`, turned by about 6 degrees.
struct Seen {
  PointSet points;
  ShapePose truth;  // from the model to the observation
  std::vector<Vec3> centers;
};

Seen seen(const std::vector<double>& scores, double from, std::uint64_t seed = 2) {
  Seen result;
  Random random(seed);
  // A small turn: the tangent half angle form of a rotation.
  const double a = 0.05 * (random.unit() - 0.5), b = 0.08 * (random.unit() - 0.5), c = 0.08 * random.unit();
  const double n = 1 + a * a + b * b + c * c;
  result.truth.rotation = {
      (1 + a * a - b * b - c * c) / n, 2 * (a * b - c) / n, 2 * (a * c + b) / n, 2 * (a * b + c) / n,
      (1 - a * a + b * b - c * c) / n, 2 * (b * c - a) / n, 2 * (a * c - b) / n, 2 * (b * c + a) / n,
      (1 - a * a - b * b + c * c) / n};
  result.truth.translation = {0.1, -0.1, 0.05};
  const ShapePrior& prior = model();
  const PointSet all = instance_points(prior, scores);
  const Vec3 middle = [&] {
    Vec3 sum;
    for (const Vec3& p : prior.points) sum = sum + (1.0 / static_cast<double>(prior.points.size())) * p;
    return sum;
  }();
  // Along the axis in which the model is longest.
  Vec3 axis;
  double longest = 0;
  for (const Vec3& p : prior.points) {
    if (length(p - middle) > longest) longest = length(p - middle), axis = p - middle;
  }
  axis = (1 / longest) * axis;
  std::vector<Vec3> points, normals;
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    if (dot(all.points[i] - middle, axis) < from) continue;
    points.push_back(transformed(result.truth, all.points[i]));
    normals.push_back(turned(result.truth, prior.normals[i]));
  }
  result.points.points = std::move(points);
  result.points.normals = std::move(normals);
  for (const Vec3& p : shape_instance(prior, scores).centers)
    result.centers.push_back(transformed(result.truth, p));
  return result;
}

double largest_error(const ShapeFit& fit, const Seen& truth) {
  double largest = 0;
  for (std::size_t i = 0; i < truth.centers.size(); ++i)
    largest = std::max(largest, distance(fit.centers[i], truth.centers[i]));
  return largest;
}

TEST(shape_fit, finds_scores_and_pose_of_an_instance_of_the_model) {
  ShapeFitOptions sure;
  sure.effective = 1e6;
  const Seen whole = seen({1.2, -0.8}, -100);
  const ShapeFit fit = shape_fit(model(), whole.points, {}, sure);
  ASSERT_EQ(broken_invariant(fit), "");
  EXPECT_NEAR(fit.scores[0], 1.2, 0.05);
  EXPECT_NEAR(fit.scores[1], -0.8, 0.05);
  EXPECT_LT(largest_error(fit, whole), 0.03);
  EXPECT_LT(fit.residual, 0.02);
  EXPECT_EQ(fit.converged, 1);
}

TEST(shape_fit, says_how_much_a_part_tells) {
  const Seen whole = seen({1.2, -0.8}, -100), part = seen({1.2, -0.8}, 0.5);
  ASSERT_LT(part.points.points.size(), whole.points.points.size() / 2);
  const ShapeFit all = shape_fit(model(), whole.points, {}), some = shape_fit(model(), part.points, {});
  for (std::size_t mode = 0; mode < 2; ++mode) {
    EXPECT_LT(all.covariance[3 * mode], some.covariance[3 * mode]);
    EXPECT_LE(some.covariance[3 * mode], 1);
  }
  // Where nobody has looked places are less certain.
  double seen_end = 0, other_end = 0;
  std::vector<std::pair<double, double>> by_distance;
  for (std::size_t i = 0; i < some.centers.size(); ++i) {
    double nearest = 1e9;
    for (const Vec3& p : part.points.points) nearest = std::min(nearest, distance(p, some.centers[i]));
    by_distance.emplace_back(nearest, some.deviations[i]);
  }
  std::sort(by_distance.begin(), by_distance.end());
  for (std::size_t i = 0; i < 8; ++i) {
    seen_end += by_distance[i].second;
    other_end += by_distance[by_distance.size() - 1 - i].second;
  }
  EXPECT_LT(seen_end, 0.7 * other_end);
}

TEST(shape_fit, few_effective_observations_stay_near_the_mean) {
  const Seen part = seen({2, 1}, 0);
  double before = 100;
  for (const double effective : {1000.0, 20.0, 0.5, 1e-6}) {
    ShapeFitOptions options;
    options.effective = effective;
    const double size = shape_fit(model(), part.points, {}, options).mahalanobis;
    EXPECT_LT(size, before);
    before = size;
  }
  EXPECT_LT(before, 0.01);
}

TEST(shape_fit, outliers_draw_the_shape_nowhere) {
  const Seen part = seen({1, 1}, -1);
  Random random(4);
  Seen noisy = part;
  std::vector<Vec3> points(part.points.points.begin(), part.points.points.end());
  std::vector<Vec3> normals(part.points.normals.begin(), part.points.normals.end());
  const Box box = bounding_box(part.points.points.span());
  const Vec3 size = box.upper - box.lower;
  for (std::size_t i = points.size() / 4; i > 0; --i) {
    points.push_back(box.lower +
                     Vec3{random.unit() * size.x, random.unit() * size.y, random.unit() * size.z});
    normals.push_back(turned(random_pose(random), {1, 0, 0}));
  }
  noisy.points.points = std::move(points);
  noisy.points.normals = std::move(normals);
  const ShapeFit clean = shape_fit(model(), part.points, {}), fit = shape_fit(model(), noisy.points, {});
  EXPECT_LT(largest_error(fit, part), 1.3 * largest_error(clean, part) + 0.03);
  EXPECT_GT(fit.outliers, 0.05);
  EXPECT_LT(fit.outliers, 0.3);
}

TEST(shape_fit, starts_from_a_pose) {
  const Seen near = seen({1, -1}, -100);
  Random random(9);
  const ShapePose away = random_pose(random, 1, 50);
  Seen far = near;
  std::vector<Vec3> points, normals;
  for (const Vec3& p : near.points.points) points.push_back(transformed(away, p));
  for (const Vec3& n : near.points.normals) normals.push_back(turned(away, n));
  far.points.points = std::move(points);
  far.points.normals = std::move(normals);
  for (Vec3& c : far.centers) c = transformed(away, c);
  const ShapeFit fit = shape_fit(model(), far.points, inverse(away));
  const ShapeFit other = shape_fit(model(), near.points, {});
  for (std::size_t mode = 0; mode < 2; ++mode) EXPECT_NEAR(fit.scores[mode], other.scores[mode], 1e-4);
  EXPECT_LT(largest_error(fit, far), 0.15);
}

TEST(shape_fit, takes_balls_with_their_radii) {
  const Balls balls = shape_instance(model(), std::vector<double>{0.5, 1.5});
  ShapeFitOptions sure;
  sure.effective = 1e6;
  const ShapeFit fit = shape_fit(model(), balls, {}, sure);
  EXPECT_NEAR(fit.scores[0], 0.5, 0.1);
  EXPECT_NEAR(fit.scores[1], 1.5, 0.1);
  double worst = 0;
  for (std::size_t i = 0; i < balls.size(); ++i)
    worst = std::max(worst, std::abs(fit.radii[i] / balls.radii[i] - 1));
  EXPECT_LT(worst, 0.02);
}

TEST(shape_fit, is_the_same_for_any_number_of_threads) {
  const Seen part = seen({1, 1}, 0);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ShapeFit a = shape_fit(model(), part.points, {});
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
  const ShapeFit b = shape_fit(model(), part.points, {});
  EXPECT_EQ(a.scores, b.scores);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.pose, b.pose);
  EXPECT_EQ(a.centers, b.centers);
}

TEST(shape_fit, tells_of_observations_that_are_no_instances) {
  {
    Warnings warnings;
    shape_fit(model(), seen({1, -1}, -1).points, {}, {}, warnings);
    EXPECT_EQ(warnings.text, "");
  }
  {
    // A shape of another kind, as large.
    PointSet cross;
    std::vector<Vec3> points;
    const Box box = bounding_box(model().points.span());
    const Vec3 middle = 0.5 * (box.lower + box.upper);
    Random random(5);
    for (int i = 0; i < 300; ++i)
      points.push_back(middle +
                       Vec3{4 * (random.unit() - 0.5), 4 * (random.unit() - 0.5), 4 * (random.unit() - 0.5)});
    cross.points = std::move(points);
    Warnings warnings;
    shape_fit(model(), cross, {}, {}, warnings);
    EXPECT_NE(warnings.text, "");
  }
  {
    PointSet away = seen({0, 0}, -100).points;
    std::vector<Vec3> points;
    for (const Vec3& p : away.points) points.push_back(p + Vec3{1000, 0, 0});
    away.points = std::move(points);
    EXPECT_THROW(shape_fit(model(), away, {}), InputError);
    away.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    away.normals = {};
    EXPECT_THROW(shape_fit(model(), away, {}), InputError);
  }
  ShapePrior bare = model();
  bare.points = bare.normals = bare.point_modes = {};
  EXPECT_THROW(shape_fit(bare, seen({0, 0}, -100).points, {}), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
