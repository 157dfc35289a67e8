#include "cover/certificate.hpp"

#include <gtest/gtest.h>

#include "cover/greedy.hpp"
#include "cover/reduce.hpp"
#include "cover/residual.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

using test::state_of;

constexpr auto certified = static_cast<std::uint8_t>(BoundHow::certified);

TEST(certificate, sums_are_rounded_up_group_by_group) {
  PricedGroups groups;
  groups.add(4, price_unit / 2);
  groups.add(7, 0);
  groups.close();
  groups.close();
  groups.add(1, price_unit);
  groups.add(2, 1);
  groups.close();
  EXPECT_EQ(groups.bound(), 1 + 2);
  EXPECT_EQ(groups.samples, (std::vector<std::int32_t>{4, 1, 2}));
  EXPECT_EQ(groups.ends, (std::vector<std::size_t>{1, 3}));
}

TEST(certificate, essential_balls_are_witnessed_by_the_sample_that_only_they_cover) {
  const CoverState original = state_of({{0, 1}, {1, 2}, {2}}, 3);
  const CoverState reduced = reduce(original);
  EXPECT_EQ(reduced.certificate_samples, (Array<std::int32_t>{0, 2}));
  EXPECT_EQ(reduced.certificate_groups, (Array<std::int32_t>{0, 1}));
  EXPECT_EQ(reduced.settled_groups, 2);
  EXPECT_EQ(reduced.certified_bound(), 2);
  EXPECT_EQ(reduced.lower_bound_how, certified);
  EXPECT_EQ(test::certificate_error(original, reduced), "");
}

TEST(certificate, holds_on_the_original_matrix_after_any_mixture_of_picks_and_reductions) {
  std::mt19937 random(41);
  int closed = 0;
  for (int round = 0; round < 2000; ++round) {
    const std::size_t rows = 4 + random() % 9, columns = 4 + random() % 12;
    const CoverState original = state_of(test::random_sets(random, rows, columns, 0.25), columns);
    const std::int64_t best = test::optimum(original);
    CoverState now = original;
    while (now.remaining() > 0) {
      now = random() % 2 == 0 ? reduce(now) : greedy(now, {.mode = GreedyMode::one_per_component});
      ASSERT_EQ(broken_invariant(now), "");
      ASSERT_EQ(test::certificate_error(original, now), "");
      ASSERT_LE(now.certified_bound(), best);
      ASSERT_EQ(now.certified_bound(), now.count(Choice::essential));
    }
    closed += now.certified_bound() == best ? 1 : 0;
  }
  EXPECT_GT(closed, 100);
}

/// Two components of three columns, each needing two of its three rows.
CoverState two_triangles() { return state_of({{0, 1}, {1, 2}, {0, 2}, {3, 4}, {4, 5}, {3, 5}}, 6); }

PricedGroups halves(std::int32_t first) {
  PricedGroups groups;
  for (std::int32_t s = first; s < first + 3; ++s) groups.add(s, price_unit / 2);
  groups.close();
  return groups;
}

TEST(certificate, prices_of_the_matrix_are_taken_over_when_they_prove_more) {
  CoverState state = two_triangles();
  PricedGroups both = halves(0);
  for (std::int32_t s = 3; s < 6; ++s) both.add(s, price_unit / 2);
  both.close();
  prove(state, both);
  EXPECT_EQ(state.lower_bound, 4);
  EXPECT_EQ(state.settled_groups, 0);
  EXPECT_EQ(test::certificate_error(two_triangles(), state), "");
  const CoverState before = state;
  prove(state, halves(0));
  EXPECT_TRUE(test::same(state, before));
}

TEST(certificate, what_was_settled_stays_when_new_prices_come) {
  CoverState state = two_triangles();
  state = choose(state, std::vector<std::int32_t>{0, 1}, Choice::exact);
  settle(state, halves(0));
  EXPECT_EQ(state.settled_groups, 1);
  EXPECT_EQ(state.lower_bound, 2);
  prove(state, halves(3));
  EXPECT_EQ(state.lower_bound, 4);
  EXPECT_EQ(state.lower_bound_how, certified);
  EXPECT_EQ(state.settled_groups, 1);
  EXPECT_EQ(broken_invariant(state), "");
  EXPECT_EQ(test::certificate_error(two_triangles(), state), "");
}

TEST(certificate, an_optimum_that_prices_do_not_reach_rests_on_the_solver) {
  CoverState state = choose(two_triangles(), std::vector<std::int32_t>{0, 1}, Choice::exact);
  prove(state, halves(3));
  EXPECT_EQ(state.certified_bound(), 2);
  EXPECT_EQ(state.lower_bound, 4);
  EXPECT_EQ(state.lower_bound_how, static_cast<std::uint8_t>(BoundHow::solver));
}

TEST(certificate, groups_of_an_earlier_matrix_go_only_for_a_better_proof) {
  CoverState state = two_triangles();
  PricedGroups both = halves(0);
  for (std::int32_t s = 3; s < 6; ++s) both.add(s, price_unit / 2);
  both.close();
  prove(state, both);
  const CoverState reduced = reduce(choose(state, std::vector<std::int32_t>{0}, Choice::greedy));
  EXPECT_EQ(reduced.count(Choice::essential), 1);  // one ball for what is left of the first triangle
  EXPECT_EQ(reduced.certified_bound(), 4);
  EXPECT_EQ(reduced.settled_groups, 0);
  EXPECT_EQ(test::certificate_error(two_triangles(), reduced), "");
}

}  // namespace
}  // namespace ballflow::geometry
