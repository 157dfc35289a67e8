#include "power/contribution.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "contribution_oracle.hpp"

namespace ballflow::geometry {
namespace {

bool contributes(const Site& site, const std::vector<Site>& others) {
  ContributionTest test;
  const bool answer = test.contributes(site, others);
  EXPECT_EQ(answer, test::contributes_by_enumeration(site, others));
  return answer;
}

TEST(contribution, alone) {
  EXPECT_TRUE(contributes({{1, 2, 3}, 4}, {}));
  EXPECT_TRUE(contributes({{1, 2, 3}, 0}, {}));
}

TEST(contribution, a_ball_inside_another_does_not_contribute) {
  EXPECT_FALSE(contributes({{0.5, 0, 0}, 0.25 * 0.25}, {{{0, 0, 0}, 1}}));
  EXPECT_FALSE(contributes({{0, 0, 0}, 0.25}, {{{0, 0, 0}, 1}}));
  EXPECT_TRUE(contributes({{0, 0, 0}, 1}, {{{0, 0, 0}, 0.25}}));
}

TEST(contribution, inner_tangency_is_decided_by_the_last_bit) {
  EXPECT_FALSE(contributes({{0.5, 0, 0}, 0.25}, {{{0, 0, 0}, 1}}));
  EXPECT_TRUE(contributes({{0.5, 0, 0}, 0.25 + 0x1p-54}, {{{0, 0, 0}, 1}}));
  EXPECT_TRUE(contributes({{0.5 + 0x1p-53, 0, 0}, 0.25}, {{{0, 0, 0}, 1}}));
  EXPECT_FALSE(contributes({{0.5, 0, 0}, 0.25 - 0x1p-54}, {{{0, 0, 0}, 1}}));
}

TEST(contribution, a_point_contributes_unless_a_ball_reaches_it) {
  EXPECT_TRUE(contributes({{1 + 0x1p-52, 0, 0}, 0}, {{{0, 0, 0}, 1}}));
  EXPECT_FALSE(contributes({{1, 0, 0}, 0}, {{{0, 0, 0}, 1}}));
  EXPECT_FALSE(contributes({{1 - 0x1p-53, 0, 0}, 0}, {{{0, 0, 0}, 1}}));
  EXPECT_TRUE(contributes({{1, 0, 0}, 0}, {{{0, 0, 0}, 0}, {{2, 0, 0}, 0}}));
}

TEST(contribution, cells_without_volume_contribute_nothing) {
  // Between the bisectors with the other two nothing is left, or next to nothing.
  const double w = 9;
  EXPECT_FALSE(contributes({{0, 0, 0}, w - 1}, {{{-1, 0, 0}, w}, {{1, 0, 0}, w}}));
  EXPECT_TRUE(contributes({{0, 0, 0}, w - 1 + 0x1p-49}, {{{-1, 0, 0}, w}, {{1, 0, 0}, w}}));
  EXPECT_FALSE(contributes({{0, 0, 0}, w - 1 - 0x1p-49}, {{{-1, 0, 0}, w}, {{1, 0, 0}, w}}));
}

TEST(contribution, four_balls_that_cover_a_fifth_do_not_keep_it_from_contributing) {
  const double w = 1.05 * 1.05 * 3;
  EXPECT_TRUE(contributes({{0, 0, 0}, 0.33 * 0.33 * 3},
                          {{{1, 1, 1}, w}, {{1, -1, -1}, w}, {{-1, 1, -1}, w}, {{-1, -1, 1}, w}}));
}

TEST(contribution, tiny_and_huge_numbers_are_decided_exactly) {
  for (const double s : {0x1p-490, 0x1p-160, 1.0, 0x1p160, 0x1p490}) {
    SCOPED_TRACE(s);
    EXPECT_FALSE(contributes({{0.5 * s, 0, 0}, 0.25 * s * s}, {{{0, 0, 0}, s * s}}));
    EXPECT_TRUE(contributes({{0.5 * s, 0, 0}, (0.25 + 0x1p-54) * s * s}, {{{0, 0, 0}, s * s}}));
    EXPECT_TRUE(contributes({{1.5 * s, 0, 0}, 0.25 * s * s}, {{{0, 0, 0}, s * s}}));
  }
  EXPECT_TRUE(contributes({{0, 0, 0}, 1e-300}, {{{0x1p400, 0, 0}, 0x1p700}}));
}

/// Sites in general position, or on a grid, where ties and tangencies abound; in a space of `dimension`.
TEST(contribution, agrees_with_enumeration_on_random_sites) {
  std::mt19937_64 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto digit = [&](unsigned n) { return static_cast<double>(random() % n); };
  ContributionTest test;
  int yes = 0, rounds = 0;
  for (int round = 0; round < 3000; ++round) {
    const bool grid = round % 2 == 0;
    const int dimension = 1 + round / 2 % 3;
    const auto make = [&] {
      Site site;
      for (double* x : {&site.center.x, &site.center.y, &site.center.z}) *x = grid ? digit(4) : uniform();
      if (dimension < 3) site.center.z = 0;
      if (dimension < 2) site.center.y = 0;
      const double r = grid ? 0.5 * digit(5) : uniform();
      site.weight = grid && round % 4 == 0 ? digit(9) : r * r;
      return site;
    };
    const Site site = make();
    std::vector<Site> others(1 + random() % 6);
    for (Site& other : others) other = make();
    const bool answer = test.contributes(site, others);
    ASSERT_EQ(answer, test::contributes_by_enumeration(site, others)) << "round " << round;
    yes += answer;
    ++rounds;
  }
  EXPECT_GT(yes, rounds / 10);
  EXPECT_LT(yes, rounds * 9 / 10);
  EXPECT_GT(test.exact_decisions(), 30u);  // the grids
  EXPECT_LT(test.exact_decisions(), 1500u);
}

/// What doubles prove must be true: sites that touch up to a few last bits.
TEST(contribution, doubles_never_prove_what_is_not_true) {
  std::mt19937_64 random(2);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  ContributionTest test;
  for (int round = 0; round < 1000; ++round) {
    // A ball inside others' reach, tangent to the first from within but for `off`.
    const Vec3 d{uniform() - 0.5, uniform() - 0.5, uniform() - 0.5};
    const double big = 2 + uniform(), off = std::ldexp(uniform() - 0.5, -static_cast<int>(random() % 60));
    const double r = big - length(d) + off;
    const Site site{d, r * r};
    std::vector<Site> others{{{0, 0, 0}, big * big}};
    for (std::size_t k = random() % 4; k > 0; --k) {
      const Vec3 c{uniform() * 4 - 2, uniform() * 4 - 2, uniform() * 4 - 2};
      others.push_back({c, uniform() * 4});
    }
    ASSERT_EQ(test.contributes(site, others), test::contributes_by_enumeration(site, others)) << round;
  }
  EXPECT_GT(test.exact_decisions(), 100u);
}

}  // namespace
}  // namespace ballflow::geometry
