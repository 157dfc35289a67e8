#include "balls/select_balls.hpp"

#include <gtest/gtest.h>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

Balls five_balls() {
  return {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},
          {0.5, 1.5, 2.5, 3.5, 4.5},
          {0, 1, 3, 3, 4, 6},
          {8, 1, 2, 5, 0, 9}};
}

/// Five balls and three samples of which nothing remains.
CoverState finished(Array<std::int32_t> chosen) {
  CoverState cover;
  cover.balls = 5;
  cover.samples = 3;
  cover.row_offsets = {0};
  cover.chosen_how = std::vector<std::uint8_t>(chosen.size());
  cover.chosen = std::move(chosen);
  return cover;
}

std::string message(const CoverState& cover) {
  try {
    select_balls(cover, five_balls(), {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(select_balls, returns_chosen_balls_ascending_with_their_samples) {
  const CoverState cover = finished({4, 0, 1});
  ASSERT_EQ(broken_invariant(cover), "");
  const Balls selected = select_balls(cover, five_balls(), {});
  EXPECT_EQ(selected.centers, (Array<Vec3>{{0, 0, 0}, {1, 0, 0}, {4, 0, 0}}));
  EXPECT_EQ(selected.radii, (Array<double>{0.5, 1.5, 4.5}));
  EXPECT_EQ(selected.defining_offsets, (Array<std::int64_t>{0, 1, 3, 5}));
  EXPECT_EQ(selected.defining_samples, (Array<std::int32_t>{8, 1, 2, 0, 9}));
  EXPECT_EQ(broken_invariant(selected), "");
}

TEST(select_balls, of_balls_without_defining_samples_has_none) {
  Balls balls = five_balls();
  balls.defining_offsets = {};
  balls.defining_samples = {};
  const Balls selected = select_balls(finished({2}), balls, {});
  EXPECT_EQ(selected.radii, (Array<double>{2.5}));
  EXPECT_TRUE(selected.defining_offsets.empty());
}

TEST(select_balls, of_an_empty_choice_is_empty) {
  const Balls selected = select_balls(finished({}), five_balls(), {});
  EXPECT_EQ(selected.size(), 0u);
  EXPECT_EQ(broken_invariant(selected), "");
}

TEST(select_balls, refuses_an_unfinished_cover_unless_allowed) {
  CoverState cover = finished({3});
  cover.row_offsets = {0, 1};
  cover.columns = {0};
  cover.row_ids = {2};
  cover.column_ids = {1};
  ASSERT_EQ(broken_invariant(cover), "");
  EXPECT_NE(message(cover).find("1 samples are not covered"), std::string::npos);
  EXPECT_EQ(select_balls(cover, five_balls(), {.allow_unfinished = true}).radii, (Array<double>{3.5}));
}

TEST(select_balls, does_not_wait_for_samples_that_no_ball_covers) {
  CoverState cover = finished({3});
  cover.uncovered = {2};
  EXPECT_EQ(select_balls(cover, five_balls(), {}).size(), 1u);
}

TEST(select_balls, refuses_a_cover_that_does_not_fit) {
  CoverState cover = finished({1});
  cover.balls = 6;
  EXPECT_NE(message(cover).find("6 balls"), std::string::npos);
  EXPECT_NE(message(finished({1, 5})).find("ball 5"), std::string::npos);
  EXPECT_NE(message(finished({1, -2})).find("ball -2"), std::string::npos);
  EXPECT_NE(message(finished({1, 3, 1})).find("ball 1 is chosen twice"), std::string::npos);
}

}  // namespace
}  // namespace ballflow::geometry
