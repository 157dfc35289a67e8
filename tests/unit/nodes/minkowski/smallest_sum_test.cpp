// Sums of which only what is needed is kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "io/load_balls.hpp"
#include "measure/union_measure.hpp"
#include "minkowski/minkowski_sum_2.hpp"
#include "minkowski_cases.hpp"
#include "power/alpha_shape.hpp"
#include "power/minimal_union.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

Numbers smallest_part(const Numbers& numbers, UnionOf of) {
  Numbers kept;
  for (const std::int32_t id : minimal_union(balls_of(numbers), {of}).kept)
    kept.push_back(numbers[static_cast<std::size_t>(id)]);
  std::sort(kept.begin(), kept.end());
  return kept;
}

TEST(smallest_sum, leaves_out_what_contributes_and_is_not_needed) {
  const double r = 1.05 * std::sqrt(3.0), s = 0.33 * std::sqrt(3.0);
  const Numbers five{{-1, -1, 1, r}, {-1, 1, -1, r}, {0, 0, 0, s}, {1, -1, -1, r}, {1, 1, 1, r}};
  for (const MinkowskiAlgorithm algorithm : algorithms) {
    const MinkowskiSum sum =
        minkowski_sum(balls_of(five), balls_of({{0, 0, 0, 0}}), {algorithm, MinkowskiKeep::minimal});
    EXPECT_EQ(numbers_of(sum.balls), (Numbers{five[0], five[1], five[3], five[4]}));
    EXPECT_EQ(sum.report.contributing, 5);
    EXPECT_EQ(sum.report.minimal, 4);
    EXPECT_EQ(sum.report.count, 4);
    EXPECT_EQ(sum.report.touching_boundary, 4);
    EXPECT_EQ(broken_invariant(sum.report), "");
  }
}

TEST(smallest_sum, is_the_smallest_part_of_all_sums) {
  RandomBalls random(21);
  int smaller = 0;
  for (int round = 0; round < 1500; ++round) {
    SCOPED_TRACE(round);
    const Numbers a = random(9), b = random(9);
    const MinkowskiSum sum = minkowski_sum(balls_of(a), balls_of(b), {.keep = MinkowskiKeep::minimal});
    ASSERT_EQ(numbers_of(sum.balls), smallest_part(all_sums(a, b), UnionOf::balls));
    ASSERT_EQ(broken_invariant(sum.report), "");
    smaller += sum.report.minimal < sum.report.contributing;
  }
  EXPECT_GT(smaller, 100);
}

TEST(smallest_sum, in_the_plane_is_the_smallest_part_of_all_discs) {
  RandomBalls random(22);
  int smaller = 0;
  for (int round = 0; round < 1500; ++round) {
    SCOPED_TRACE(round);
    Numbers a = random(9), b = random(9);
    for (Numbers* set : {&a, &b}) {
      for (auto& ball : *set) ball[2] = 0;
    }
    for (const MinkowskiAlgorithm2 algorithm :
         {MinkowskiAlgorithm2::filtered, MinkowskiAlgorithm2::hierarchical}) {
      const MinkowskiSum2 sum =
          minkowski_sum_2(balls_of(a), balls_of(b), {algorithm, MinkowskiKeep::minimal});
      ASSERT_EQ(numbers_of(sum.balls), smallest_part(all_sums(a, b), UnionOf::discs));
      ASSERT_EQ(broken_invariant(sum.report), "");
      smaller += sum.report.minimal < sum.report.contributing;
    }
  }
  EXPECT_GT(smaller, 300);
}

TEST(smallest_sum, of_nothing_is_nothing) {
  const MinkowskiSum sum = minkowski_sum({}, balls_of({{0, 0, 0, 1}}), {.keep = MinkowskiKeep::minimal});
  EXPECT_EQ(sum.report.minimal, 0);
  EXPECT_EQ(broken_invariant(sum.report), "");
  EXPECT_EQ(minkowski_sum_2({}, {}, {.keep = MinkowskiKeep::minimal}).report.minimal, 0);
}

Balls pinned(const char* name) {
  return load_balls({.file = ballflow::test::source_file(std::string("tests/data/minkowski/") + name)}).balls;
}

Balls every_third(const Balls& balls) {
  std::vector<std::int32_t> ids;
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(balls.size()); id += 3) ids.push_back(id);
  return select(balls, ids);
}

double volume(const Balls& balls) { return union_measure(alpha_shape(balls, {}, no_monitor())).volume; }

/// Balls of an inner ear and of a knot (thesis, Table 5.2), made by bench_minkowski: 4 million pairs with
/// BALLFLOW_TEST_LARGE=1 (tools/nightly sums), else every third ball of each.
TEST(smallest_sum, of_an_ear_and_a_knot_has_the_same_volume_and_nothing_to_spare) {
  Balls ear = pinned("inner_ear.xyzr.gz"), knot = pinned("knot.xyzr.gz");
  ASSERT_EQ(ear.size(), 2972u);
  ASSERT_EQ(knot.size(), 1433u);
  const bool whole = std::getenv("BALLFLOW_TEST_LARGE") != nullptr;
  if (!whole) {
    ear = every_third(ear);
    knot = every_third(knot);
  }
  const std::int64_t contributing = whole ? 159038 : 35986;
  const MinkowskiSum all = minkowski_sum(ear, knot);
  EXPECT_EQ(all.report.contributing, contributing);
  EXPECT_EQ(all.report.minimal, -1);
  const MinkowskiSum least = minkowski_sum(ear, knot, {.keep = MinkowskiKeep::minimal});
  EXPECT_EQ(least.report.contributing, contributing);
  EXPECT_EQ(least.report.touching_boundary, all.report.touching_boundary);
  EXPECT_GE(least.report.minimal, least.report.touching_boundary)
      << "those on the boundary alone leave voids";
  EXPECT_LT(least.report.minimal, whole ? 50000 : 17000);
  EXPECT_EQ(least.report.lower, all.report.lower);
  EXPECT_EQ(least.report.upper, all.report.upper);
  const double before = volume(all.balls);
  EXPECT_NEAR(volume(least.balls), before, 1e-11 * before);
  const MinimalUnion again = minimal_union(least.balls);
  EXPECT_EQ(again.kept.size(), least.balls.size());
  EXPECT_EQ(again.contributing, least.report.minimal);
}

}  // namespace
}  // namespace ballflow::geometry
