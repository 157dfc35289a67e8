#include "prior/drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "prior/choose_template.hpp"
#include "prior/kernel_basis.hpp"
#include "prior_examples.hpp"
#include "sample/generate.hpp"

namespace ballflow::geometry {
namespace {

TEST(kernel_basis, multiplies_to_the_kernel) {
  Random random(1);
  const std::vector<Vec3> points = random_points(random, 80);
  const double width = 0.7, tolerance = 1e-6;
  const KernelBasis basis(points, width, tolerance, 1000);
  EXPECT_LT(basis.rank(), 80u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      double product = 0;
      for (std::size_t k = 0; k < basis.rank(); ++k) product += basis.row(i)[k] * basis.row(j)[k];
      // The remainder is positive semidefinite with a diagonal of at most the tolerance.
      EXPECT_NEAR(product, std::exp(-squared_distance(points[i], points[j]) / (2 * width * width)),
                  1.01 * tolerance);
    }
  }
  EXPECT_EQ(KernelBasis(points, width, tolerance, 5).rank(), 5u);
  EXPECT_EQ(KernelBasis(std::vector<Vec3>(4, Vec3{1, 1, 1}), width, tolerance, 9).rank(), 1u);
}

/// Points moved by a gentle bend.
std::vector<Vec3> bent(const std::vector<Vec3>& points) {
  std::vector<Vec3> result;
  for (const Vec3& p : points) result.push_back(p + Vec3{0, 0.15 * p.x * p.x, 0.1 * p.y});
  return result;
}

TEST(drift, follows_a_bend_and_carries_what_belongs_to_no_group) {
  Random random(2);
  std::vector<Vec3> points = random_points(random, 150), inside = random_points(random, 10);
  const std::vector<Vec3> targets = bent(points), truth = bent(inside);
  points.insert(points.end(), inside.begin(), inside.end());
  const std::vector<DriftGroup> groups = {{0, 150, {}, targets, {}, false}};
  DriftOptions options;
  options.width = 1;
  options.stiffness = 1;
  const Drift found = drift(points, groups, options);
  double mean = 0, before = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    mean += distance(found.points[150 + i], truth[i]) / 10;
    before += distance(inside[i], truth[i]) / 10;
  }
  EXPECT_LT(mean, 0.15 * before);
  EXPECT_LT(found.deviation, 0.02);
}

TEST(drift, planes_leave_samples_of_flat_faces_where_they_lie) {
  // Two samplings of one box: points pull at each other, planes have nothing to do.
  const PointSet one = samples_of(bump_box(4), 500, 1), other = samples_of(bump_box(4), 500, 2);
  std::vector<Vec3> points, targets;
  for (const Vec3& p : one.points) points.push_back(0.3 * p);
  for (const Vec3& p : other.points) targets.push_back(0.3 * p);
  const auto mean_move = [&](bool planes) {
    const std::vector<DriftGroup> groups = {{0, 500, one.normals, targets, other.normals, planes}};
    const Drift found = drift(points, groups, {});
    double sum = 0;
    for (std::size_t i = 0; i < 500; ++i) sum += distance(found.points[i], points[i]) / 500;
    return sum;
  };
  EXPECT_LT(mean_move(true), 0.5 * mean_move(false));
}

TEST(drift, far_targets_move_nothing) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, targets = {{50, 0, 0}};
  const Drift found = drift(points, std::vector<DriftGroup>{{0, 3, {}, targets, {}, false}}, {});
  EXPECT_EQ(found.points, points);
}

TEST(choose_template, takes_the_one_in_the_middle_in_any_order_and_pose) {
  Random random(4);
  std::vector<PointSet> shapes;
  for (const double r : {0.1, 0.2, 0.24, 0.28, 0.38})
    shapes.push_back(
        moved(samples_of(generate({Shape::bracket, 2000, 1, r}), 250, 3), random_pose(random, 1 + r)));
  EXPECT_EQ(choose_template(shapes, {}), 2u);
  std::swap(shapes[0], shapes[2]);
  std::swap(shapes[1], shapes[4]);
  EXPECT_EQ(choose_template(shapes, {}), 0u);
  EXPECT_EQ(choose_template(shapes, {.instance = 3}), 3u);
}

TEST(choose_template, warns_of_a_shape_that_is_there_twice) {
  Random random(5);
  std::vector<PointSet> shapes;
  for (const double r : {0.1, 0.2, 0.3})
    shapes.push_back(samples_of(generate({Shape::bracket, 2000, 1, r}), 100, 3));
  Warnings none, twice;
  choose_template(shapes, {}, none);
  EXPECT_EQ(none.text, "");
  shapes.push_back(moved(shapes[1], random_pose(random, 3)));
  choose_template(shapes, {}, twice);
  EXPECT_NE(twice.text.find("instances 1 and 3 are the same shape"), std::string::npos) << twice.text;
}

TEST(choose_template, refuses_what_has_no_middle) {
  const PointSet good = samples_of(generate({Shape::bracket, 2000}), 50, 3);
  EXPECT_THROW(choose_template({}, {}), InputError);
  EXPECT_THROW(choose_template(std::vector<PointSet>{good}, {.instance = 1}), InputError);
  EXPECT_THROW(choose_template(std::vector<PointSet>{good, PointSet{}}, {}), InputError);
  EXPECT_EQ(choose_template(std::vector<PointSet>{good}, {}), 0u);
}

}  // namespace
}  // namespace ballflow::geometry
