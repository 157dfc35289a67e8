#include "minkowski/slab_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "contribution_oracle.hpp"
#include "minkowski_cases.hpp"

namespace ballflow::geometry {
namespace {

std::vector<Ball> list(const Numbers& numbers) {
  std::vector<Ball> balls;
  for (const auto& [x, y, z, r] : numbers) balls.push_back({{x, y, z}, r});
  return balls;
}

Numbers sorted(const std::vector<Ball>& balls) {
  Numbers numbers;
  for (const Ball& b : balls) numbers.push_back({b.center.x, b.center.y, b.center.z, b.radius});
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

Contributing at_once(const Numbers& numbers) {
  PowerTriangulation triangulation;
  triangulation.insert(list(numbers), no_monitor());
  return triangulation.contributing(no_monitor());
}

TEST(slab_sums, say_what_one_triangulation_says) {
  RandomBalls random(31);
  for (int round = 0; round < 4000; ++round) {
    SCOPED_TRACE(round);
    const Numbers numbers = random(round % 10 == 0 ? 200 : 25);
    const Contributing one = at_once(numbers);
    const Contributing many = contributing_in_slabs(list(numbers), 2 + random.below(5), no_monitor());
    ASSERT_EQ(sorted(many.balls), sorted(one.balls));
    ASSERT_EQ(many.touching_boundary, one.touching_boundary);
  }
}

/// Small balls between large ones that reach through several walls.
TEST(slab_sums, know_what_reaches_through_walls) {
  RandomBalls random(32);
  int asked = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    Numbers numbers(120);
    for (auto& [x, y, z, r] : numbers) {
      x = random.uniform(0, 6), y = random.uniform(0, 1), z = random.uniform(0, 1);
      r = random.below(4) == 0 ? random.uniform(0.5, 2) : random.uniform(0, 0.4);
      if (round % 2 == 0) {
        for (double* number : {&x, &y, &z, &r})
          *number = std::round(8 * *number) / 8;  // walls through centers
      }
    }
    const Contributing one = at_once(numbers);
    for (const std::size_t slabs : {std::size_t{2}, std::size_t{3}, std::size_t{8}}) {
      const Contributing many = contributing_in_slabs(list(numbers), slabs, no_monitor());
      ASSERT_EQ(sorted(many.balls), sorted(one.balls));
      ASSERT_EQ(many.touching_boundary, one.touching_boundary);
    }
    if (round % 30 != 0) continue;
    // And that is what enumeration says, of some.
    std::vector<Site> sites;
    for (const auto& [x, y, z, r] : numbers) sites.push_back({{x, y, z}, r * r});
    const Numbers found = sorted(one.balls);
    for (std::size_t i = 0; i < 12; ++i) {
      if (std::count(numbers.begin(), numbers.end(), numbers[i]) > 1) continue;
      std::vector<Site> near;  // others do not matter
      for (std::size_t k = 0; k < sites.size(); ++k) {
        const double reach = numbers[i][3] + numbers[k][3];
        if (k != i && distance(sites[i].center, sites[k].center) <= reach + 1e-9) near.push_back(sites[k]);
      }
      if (near.size() > 24) continue;
      ASSERT_EQ(test::contributes_by_enumeration(sites[i], near),
                std::binary_search(found.begin(), found.end(), numbers[i]));
      ++asked;
    }
  }
  EXPECT_GT(asked, 3);
}

TEST(slab_sums, are_as_many_as_pay) {
  EXPECT_EQ(slabs_for(0), 1u);
  EXPECT_EQ(slabs_for(1000), 1u);
  EXPECT_LE(slabs_for(std::size_t{1} << 30), 8u);
}

}  // namespace
}  // namespace ballflow::geometry
