#include "minkowski/containment_filter.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace ballflow::geometry {
namespace {

Box box_of(const std::vector<Ball>& balls) {
  Box box;
  for (const Ball& ball : balls) box.add(ball.center);
  return box;
}

ContainmentFilter filter_of(const std::vector<Ball>& balls, double voxels) {
  ContainmentFilter filter(box_of(balls), voxels);
  for (const Ball& ball : balls) filter.offer(ball);
  filter.spread(no_monitor());
  return filter;
}

TEST(containment_filter, neither_a_ball_itself_nor_one_that_touches_from_inside_is_contained) {
  const std::vector<Ball> balls{{{0, 0, 0}, 1}, {{0.5, 0, 0}, 0.5}, {{0.25, 0, 0}, 0.5}};
  const ContainmentFilter filter = filter_of(balls, 1);
  EXPECT_FALSE(filter.contains(balls[0]));
  EXPECT_FALSE(filter.contains(balls[1]));
  EXPECT_TRUE(filter.contains(balls[2]));
}

TEST(containment_filter, what_it_says_is_inside_is_inside_and_that_is_most_of_it) {
  std::mt19937_64 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (const bool flat : {false, true}) {
    std::vector<Ball> balls(3000);
    for (Ball& ball : balls) {
      ball = {{uniform(), uniform(), flat ? 0 : uniform()}, 0.2 * uniform() * uniform()};
    }
    const ContainmentFilter filter = filter_of(balls, 200);
    int inside = 0, found = 0;
    for (const Ball& ball : balls) {
      bool contained = false;
      for (const Ball& other : balls) {
        contained = contained || distance(ball.center, other.center) + ball.radius < other.radius;
      }
      inside += contained;
      if (!filter.contains(ball)) continue;
      EXPECT_TRUE(contained);
      ++found;
    }
    EXPECT_GT(inside, 1000);
    EXPECT_GT(found, inside / 2);
  }
}

TEST(containment_filter, merged_parts_hold_what_one_filter_holds) {
  // Balls on a grid: many are equally deep in a voxel, and the first of them stays.
  std::mt19937_64 random(2);
  std::vector<Ball> balls(5000);
  const auto digit = [&] { return static_cast<double>(random() % 16) / 16; };
  for (Ball& ball : balls) ball = {{digit(), digit(), digit()}, 0.25 * digit()};
  const ContainmentFilter whole = filter_of(balls, 500);
  for (const std::size_t parts : {2u, 3u, 8u}) {
    std::vector<ContainmentFilter> filters(parts, ContainmentFilter(box_of(balls), 500));
    for (std::size_t i = 0; i < balls.size(); ++i) filters[i * parts / balls.size()].offer(balls[i]);
    for (std::size_t part = 1; part < parts; ++part) filters[0].merge(filters[part]);
    filters[0].spread(no_monitor());
    for (const Ball& ball : balls) {
      ASSERT_EQ(filters[0].contains(ball), whole.contains(ball));
      const Ball shifted{{ball.center.x + 0x1p-6, ball.center.y, ball.center.z}, 0.75 * ball.radius};
      ASSERT_EQ(filters[0].contains(shifted), whole.contains(shifted));
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry
