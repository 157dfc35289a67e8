#include "types/cover_state.hpp"

#include <gtest/gtest.h>

#include "cover_oracle.hpp"

namespace ballflow::geometry {
namespace {

/// Two rows, three columns, one choice made, one sample uncovered: nothing is wrong with it.
CoverState sound() {
  CoverState state = test::state_of({{0, 1}, {1, 3}}, 4);  // sample 2 is uncovered
  state.balls = 3;
  state.chosen = {2};
  state.chosen_how = {static_cast<std::uint8_t>(Choice::greedy)};
  state.certificate_samples = {0, 1, 3};
  state.certificate_prices = {1, 2, 1 << 20};
  state.certificate_groups = {0, 0, 1};
  state.settled_groups = 1;
  state.lower_bound = 2;
  state.lower_bound_how = static_cast<std::uint8_t>(BoundHow::certified);
  return state;
}

TEST(cover_state, accepts_a_sound_state) { EXPECT_EQ(broken_invariant(sound()), ""); }

TEST(cover_state, every_broken_invariant_is_named) {
  const auto broken = [](auto change) {
    CoverState state = sound();
    change(state);
    return broken_invariant(state);
  };
  EXPECT_NE(broken([](auto& s) { s.balls = -1; }).find("balls"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.balls = std::int64_t{1} << 31; }).find("balls"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.left_out = -1; }).find("left_out"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.left_out = 4; }).find("left_out"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.samples = 3; }).find("column_ids[2]"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.row_ids = {1, 0}; }).find("row_ids[1]"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.uncovered = {1}; }).find("sample 1"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.row_offsets = {}; }).find("row_offsets"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.row_offsets = {1, 2, 4}; }).find("row_offsets[0]"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.row_offsets = {0, 2, 3}; }).find("row_offsets"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.row_offsets = {0, 6, 4}; }).find("row_offsets[2]"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.columns = {0, 1, 1, 3}; }).find("row 1 has column 3"), std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.columns = {1, 0, 1, 2};
            }).find("row 0 does not ascend"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.columns = {0, 1, 0, 1};
            }).find("column 2 is in no row"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.chosen = {2, 2}; }).find("chosen_how"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.chosen = {1}; }).find("chosen[0]"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.chosen = {3}; }).find("chosen[0]"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.chosen_how = {9}; }).find("chosen_how[0]"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.lower_bound = -2; }).find("lower_bound"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.lower_bound_how = 5; }).find("lower_bound_how"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.lower_bound_how = 0; }).find("lower_bound_how"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.lower_bound = -1; }).find("lower_bound_how"), std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.certificate_samples = {0, 1};
            }).find("certificate_samples has 2"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.certificate_samples = {0, 1, 4};
            }).find("certificate_samples[2] = 4"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.certificate_samples = {0, 1, 0};
            }).find("listed twice"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.certificate_samples = {1, 0, 3};
            }).find("certificate_samples[1]"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.certificate_prices = {1, 0, 1};
            }).find("certificate_prices[1]"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.certificate_prices = {1, 1, (1 << 20) + 1};
            }).find("certificate_prices[2]"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.certificate_groups = {0, 0, 2};
            }).find("certificate_groups[2]"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.certificate_groups = {1, 1, 1};
            }).find("certificate_groups[0]"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) {
              s.certificate_groups = {0, 1, 0};
            }).find("certificate_groups[2]"),
            std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.settled_groups = 3; }).find("settled_groups"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.settled_groups = -1; }).find("settled_groups"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.lower_bound = 3; }).find("called certified"), std::string::npos);
  EXPECT_NE(broken([](auto& s) { s.lower_bound = 1; }).find("certificate claims, 2"), std::string::npos);
}

TEST(cover_state, a_bound_above_a_finished_cover_is_a_lie) {
  CoverState state = test::state_of({}, 0);
  state.balls = 1;
  state.chosen = {0};
  state.chosen_how = {0};
  state.lower_bound = 1;
  state.lower_bound_how = static_cast<std::uint8_t>(BoundHow::solver);
  EXPECT_EQ(broken_invariant(state), "");
  state.lower_bound = 2;
  EXPECT_NE(broken_invariant(state).find("lower_bound"), std::string::npos);
}

TEST(cover_state, knows_its_gap_only_when_finished_and_bounded) {
  CoverState state = sound();
  state.lower_bound = 1;
  EXPECT_FALSE(state.upper_bound());
  EXPECT_FALSE(state.gap());
  state = test::state_of({}, 0);
  state.balls = 3;
  state.chosen = {0, 1, 2};
  state.chosen_how = {0, 1, 2};
  EXPECT_FALSE(state.gap());
  state.lower_bound = 2;
  EXPECT_EQ(state.upper_bound(), 3);
  EXPECT_EQ(state.gap(), 0.5);
  EXPECT_EQ(state.count(Choice::exact), 1);
}

}  // namespace
}  // namespace ballflow::geometry
