#include "cover/greedy.hpp"

#include <gtest/gtest.h>

#include "cover/reduce.hpp"
#include "cover/residual.hpp"
#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

using test::row_sets;
using test::Sets;
using test::state_of;

constexpr GreedyOptions per_component{.mode = GreedyMode::one_per_component};

/// Listing 3.1: recount everything before every pick.
std::vector<std::int32_t> listing_3_1(const CoverState& state) {
  const Sets rows = row_sets(state);
  std::set<std::int32_t> left(state.column_ids.begin(), state.column_ids.end());
  std::vector<std::int32_t> picks;
  while (!left.empty()) {
    std::size_t best = 0;
    std::ptrdiff_t gain = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto count =
          std::count_if(rows[i].begin(), rows[i].end(), [&](std::int32_t c) { return left.contains(c); });
      if (count > gain) {
        gain = count;
        best = i;
      }
    }
    picks.push_back(state.row_ids[best]);
    for (const std::int32_t c : rows[best]) left.erase(c);
  }
  return picks;
}

TEST(greedy, picks_what_listing_3_1_picks) {
  std::mt19937 random(12);
  for (int round = 0; round < 400; ++round) {
    const std::size_t rows = 1 + random() % 60, columns = 1 + random() % 90;
    const CoverState state =
        state_of(test::random_sets(random, rows, columns, 0.02 + 0.2 * test::unit(random)), columns);
    const CoverState covered = greedy(state);
    ASSERT_EQ(std::vector<std::int32_t>(covered.chosen.begin(), covered.chosen.end()), listing_3_1(state));
    ASSERT_EQ(broken_invariant(covered), "");
    ASSERT_TRUE(test::covers(state, covered));
  }
}

TEST(greedy, stops_when_every_sample_is_covered) {
  const CoverState covered = greedy(state_of({{0, 1, 2, 3}, {0, 1}, {2, 3}, {3}}, 4));
  EXPECT_EQ(covered.chosen, (Array<std::int32_t>{0}));
  EXPECT_EQ(covered.remaining(), 0u);
  EXPECT_EQ(covered.rows(), 0u);
  EXPECT_EQ(covered.gap(), 0.0);
}

TEST(greedy, prefers_the_lowest_ball_among_equals) {
  EXPECT_EQ(greedy(state_of({{2, 3}, {0, 1}, {1, 2}}, 4)).chosen, (Array<std::int32_t>{0, 1}));
}

TEST(greedy, bounds_enclose_the_optimum) {
  std::mt19937 random(13);
  for (int round = 0; round < 3000; ++round) {
    const std::size_t rows = 1 + random() % 12, columns = 1 + random() % 20;
    const CoverState state =
        state_of(test::random_sets(random, rows, columns, 0.05 + 0.4 * test::unit(random)), columns);
    const std::int64_t best = test::optimum(state);
    for (const bool remove_redundant : {false, true}) {
      const CoverState covered = greedy(state, {.remove_redundant = remove_redundant});
      ASSERT_LE(covered.lower_bound, best);
      ASSERT_GE(covered.lower_bound, 1);
      ASSERT_GE(*covered.upper_bound(), best);
    }
  }
}

TEST(greedy, bounds_hold_after_any_mixture_of_greedy_picks_and_reductions) {
  std::mt19937 random(14);
  int tight = 0;
  for (int round = 0; round < 2000; ++round) {
    const std::size_t rows = 4 + random() % 9, columns = 4 + random() % 12;
    const CoverState state = state_of(test::random_sets(random, rows, columns, 0.25), columns);
    const std::int64_t best = test::optimum(state);
    CoverState now = state;
    while (now.remaining() > 0) {
      now = random() % 2 == 0 ? reduce(now) : greedy(now, per_component);
      ASSERT_EQ(broken_invariant(now), "");
      ASSERT_LE(now.lower_bound, best);
    }
    ASSERT_TRUE(test::covers(state, now));
    const auto size = static_cast<std::int64_t>(now.chosen.size());
    ASSERT_GE(size, best);
    ASSERT_LE(size - now.count(Choice::greedy), best) << "Lemma 3.7";
    ASSERT_GE(now.lower_bound, size - now.count(Choice::greedy));
    tight += now.lower_bound == best ? 1 : 0;
  }
  EXPECT_GT(tight, 200);
}

TEST(greedy, bounds_hold_after_choices_of_which_nothing_is_claimed) {
  std::mt19937 random(16);
  int tight = 0, larger = 0;
  for (int round = 0; round < 5000; ++round) {
    const std::size_t rows = 4 + random() % 8, columns = 4 + random() % 12;
    const CoverState state = state_of(test::random_sets(random, rows, columns, 0.25), columns);
    const std::int64_t best = test::optimum(state);
    CoverState now = state;
    while (now.remaining() > 0) {
      switch (random() % 4) {
        case 0:
          now = reduce(now);
          break;
        case 1:
          now = greedy(now, per_component);
          break;
        case 2:
          now = greedy(now);
          break;
        default: {
          std::vector<std::int32_t> some;
          for (std::size_t i = 0; i < now.rows(); ++i) {
            if (random() % 4 == 0) some.push_back(static_cast<std::int32_t>(i));
          }
          std::shuffle(some.begin(), some.end(), random);
          constexpr Choice claims_nothing[]{Choice::trusted, Choice::searched, Choice::all, Choice::greedy};
          now = choose(now, some, claims_nothing[random() % 4]);
          raise_lower_bound(now);
        }
      }
      ASSERT_EQ(broken_invariant(now), "");
      ASSERT_LE(now.lower_bound, best);
    }
    ASSERT_TRUE(test::covers(state, now));
    const auto size = static_cast<std::int64_t>(now.chosen.size());
    ASSERT_EQ(now.upper_bound(), size);
    ASSERT_GE(size, best);
    tight += now.lower_bound == best ? 1 : 0;
    larger += size > best ? 1 : 0;
  }
  EXPECT_GT(tight, 500);
  EXPECT_GT(larger, 500);
}

TEST(greedy, proves_one_ball_for_every_component) {
  const CoverState covered = greedy(state_of({{0, 1, 2}, {3}, {4, 5}}, 6));
  EXPECT_EQ(covered.lower_bound, 3);
  EXPECT_EQ(covered.gap(), 0.0);
}

TEST(greedy, takes_one_longest_row_of_every_component) {
  const CoverState state = state_of({{0, 1}, {1, 2}, {0, 2}, {3, 4, 5}, {5, 6}, {7}}, 8);
  const CoverState next = greedy(state, per_component);
  EXPECT_EQ(next.chosen, (Array<std::int32_t>{0, 3, 5}));
  EXPECT_EQ(next.row_ids, (Array<std::int32_t>{1, 2, 4}));
  EXPECT_EQ(row_sets(next), (Sets{{2}, {2}, {6}}));
  EXPECT_EQ(next.count(Choice::greedy), 3);
}

TEST(greedy, drops_picks_that_later_picks_make_redundant) {
  // The long row goes first, and then the other two cover all of it.
  const Sets rows{{1, 2, 3, 4}, {0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(greedy(state_of(rows, 6)).chosen, (Array<std::int32_t>{0, 1, 2}));
  const CoverState lean = greedy(state_of(rows, 6), {.remove_redundant = true});
  EXPECT_EQ(lean.chosen, (Array<std::int32_t>{1, 2}));
  EXPECT_EQ(lean.remaining(), 0u);
}

TEST(greedy, without_redundant_picks_every_pick_has_a_sample_of_its_own) {
  std::mt19937 random(15);
  for (int round = 0; round < 200; ++round) {
    const CoverState state = state_of(test::random_sets(random, 40, 60, 0.1), 60);
    const CoverState covered = greedy(state, {.remove_redundant = true});
    ASSERT_TRUE(test::covers(state, covered));
    ASSERT_LE(covered.chosen.size(), greedy(state).chosen.size());
    const Sets rows = row_sets(state);
    for (const std::int32_t left_out : covered.chosen) {
      std::set<std::int32_t> covered_by_others;
      for (const std::int32_t b : covered.chosen) {
        const auto& row = rows[static_cast<std::size_t>(b)];
        if (b != left_out) covered_by_others.insert(row.begin(), row.end());
      }
      ASSERT_LT(covered_by_others.size(), state.cols());
    }
  }
}

TEST(greedy, keeps_every_ball_in_mode_all) {
  const CoverState kept = greedy(state_of({{0, 1}, {}, {1}}, 2), {.mode = GreedyMode::all});
  EXPECT_EQ(kept.chosen, (Array<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(kept.count(Choice::all), 3);
  EXPECT_EQ(kept.remaining(), 0u);
  EXPECT_LE(kept.lower_bound, 1);
  EXPECT_EQ(broken_invariant(kept), "");
}

TEST(greedy, accepts_an_empty_matrix) {
  for (const auto mode : {GreedyMode::until_covered, GreedyMode::one_per_component, GreedyMode::all}) {
    const CoverState covered = greedy(state_of({}, 0), {.mode = mode});
    EXPECT_TRUE(covered.chosen.empty());
    EXPECT_EQ(broken_invariant(covered), "");
  }
}

}  // namespace
}  // namespace ballflow::geometry
