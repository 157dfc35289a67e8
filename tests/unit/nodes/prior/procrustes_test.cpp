#include "prior/procrustes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "prior_examples.hpp"

namespace ballflow::geometry {
namespace {

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, distance(a[i], b[i]));
  return largest;
}

TEST(procrustes, finds_the_transform_that_points_went_through) {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    const bool mirror = round % 3 == 0, similarity = round % 2 == 0;
    ShapePose truth = random_pose(random, similarity ? 0.7 + 0.7 * random.unit() : 1);
    if (mirror) {
      for (double& entry : truth.rotation) entry = -entry;
      truth.mirrored = 1;
    }
    const std::vector<Vec3> from = random_points(random, 20), to = moved(from, truth);
    const ShapePose found = labelled_pose(from, to, {}, {similarity, mirror});
    EXPECT_EQ(broken_invariant(found), "");
    EXPECT_LT(largest_distance(moved(from, found), to), 1e-12);
    EXPECT_NEAR(found.scale, truth.scale, 1e-12);
    EXPECT_LT(degrees_between(found, truth), 1e-5);
    EXPECT_LT(largest_distance(moved(to, inverse(found)), from), 1e-12);
  }
}

TEST(procrustes, no_transform_nearby_is_better) {
  Random random(4);
  for (int round = 0; round < 50; ++round) {
    const std::vector<Vec3> from = random_points(random, 6), to = random_points(random, 6);
    const std::vector<double> weights = {1, 2, 0.5, 0, 1, 3};
    const auto cost = [&](const ShapePose& pose) {
      double sum = 0, total = 0;
      for (std::size_t i = 0; i < 6; ++i) {
        sum += weights[i] * squared_distance(transformed(pose, from[i]), to[i]);
        total += weights[i];
      }
      return std::sqrt(sum / total);
    };
    const ShapePose best = labelled_pose(from, to, weights, {.similarity = true});
    EXPECT_NEAR(best.forward, cost(best), 1e-12);
    for (int k = 0; k < 100; ++k) {
      ShapePose other = random_pose(random, 0.1 + 2 * random.unit());
      if (k % 2 == 0) {  // or a small step from the best one
        const double step = 0.01 * (random.unit() - 0.5);
        other = best;
        other.scale *= 1 + step;
        other.translation = other.translation + Vec3{step, -step, step};
      }
      EXPECT_GE(cost(other), best.forward - 1e-12);
    }
  }
}

TEST(procrustes, a_mirror_image_is_not_taken_for_a_rotation) {
  Random random(5);
  const std::vector<Vec3> from = random_points(random, 30);
  std::vector<Vec3> to = from;
  for (Vec3& p : to) p.x = -p.x;
  EXPECT_GT(labelled_pose(from, to, {}, {}).forward, 0.1);
  EXPECT_LT(labelled_pose(from, to, {}, {.mirror = true}).forward, 1e-12);
}

TEST(procrustes, points_that_leave_it_open_give_a_valid_transform) {
  const std::vector<Vec3> point = {{1, 2, 3}}, other = {{4, 4, 4}};
  const ShapePose one = labelled_pose(point, other, {}, {});
  EXPECT_EQ(broken_invariant(one), "");
  EXPECT_EQ(one.scale, 1);
  EXPECT_EQ(transformed(one, point[0]), other[0]);
  const std::vector<Vec3> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
                          turned_line = {{0, 0, 0}, {0, 2, 0}, {0, 4, 0}};
  const ShapePose along = labelled_pose(line, turned_line, {}, {});
  EXPECT_EQ(broken_invariant(along), "");
  EXPECT_NEAR(along.scale, 2, 1e-12);
  EXPECT_LT(largest_distance(moved(line, along), turned_line), 1e-12);
}

TEST(procrustes, the_unit_of_length_does_not_matter) {
  Random random(6);
  const std::vector<Vec3> from = random_points(random, 10);
  for (const double unit : {1e-60, 1e60}) {
    std::vector<Vec3> scaled = from;
    for (Vec3& p : scaled) p = unit * p;
    const ShapePose found = labelled_pose(scaled, from, {}, {});
    EXPECT_NEAR(found.scale * unit, 1, 1e-12);
    EXPECT_LT(largest_distance(moved(scaled, found), from), 1e-12);
  }
}

}  // namespace
}  // namespace ballflow::geometry
