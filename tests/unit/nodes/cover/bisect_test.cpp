#include "cover/bisect.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace ballflow::geometry {
namespace {

CoverState cover_of(std::int64_t balls) {
  CoverState cover;
  cover.balls = balls;
  cover.samples = 1;
  cover.row_offsets = {0};
  std::vector<std::int32_t> chosen;
  for (std::int64_t i = 0; i < balls; ++i) chosen.push_back(static_cast<std::int32_t>(i));
  cover.chosen = chosen;
  cover.chosen_how = std::vector<std::uint8_t>(chosen.size(), 2);
  return cover;
}

struct BisectWarnings final : Monitor {
  std::vector<std::string> texts;
  void warn(const std::string& text) override { texts.push_back(text); }
};

struct Found {
  Bisection search;
  std::vector<std::string> warnings;
};

/// Searches as a loop does; `needed` says how many balls a growth needs.
Found search(const BisectOptions& options, const std::function<std::int64_t(double)>& needed) {
  Found found{begin_bisection(options), {}};
  BisectWarnings warnings;
  for (int i = 0; i < 200 && found.search.done == 0; ++i) {
    EXPECT_EQ(broken_invariant(found.search), "");
    found.search = bisect(found.search, cover_of(needed(found.search.value)), options, warnings);
  }
  EXPECT_EQ(found.search.done, 1);
  EXPECT_EQ(broken_invariant(found.search), "");
  EXPECT_LE(found.search.balls, options.balls);
  EXPECT_EQ(found.search.balls, needed(found.search.value));
  found.warnings = warnings.texts;
  return found;
}

std::int64_t falling(double growth) { return 1 + static_cast<std::int64_t>(1000 / (1 + 5 * growth)); }

TEST(bisect, finds_a_growth_that_needs_nearly_as_many_balls_as_allowed) {
  for (const std::int64_t k : {3, 10, 50, 137, 400, 900}) {
    for (const double tolerance : {0.1, 0.02}) {
      const Found found = search({.balls = k, .tolerance = tolerance}, falling);
      EXPECT_GE(static_cast<double>(found.search.balls), std::floor((1 - tolerance) * static_cast<double>(k)))
          << k;
      EXPECT_LE(found.search.tried, 20) << k;
      EXPECT_TRUE(found.warnings.empty() || tolerance * static_cast<double>(k) < 1) << k;
    }
  }
}

TEST(bisect, finds_the_exact_number_when_there_is_one) {
  EXPECT_EQ(search({.balls = 100, .tolerance = 0}, falling).search.balls, 100);
}

TEST(bisect, stays_below_where_the_number_jumps_and_says_so) {
  const auto jump = [](double growth) { return growth < 2.345 ? std::int64_t{70} : std::int64_t{40}; };
  const Found found = search({.balls = 50}, jump);
  EXPECT_EQ(found.search.balls, 40);
  EXPECT_EQ(found.search.balls_before, 70);
  EXPECT_GE(found.search.value, 2.345);
  EXPECT_LT(found.search.value, 2.345 * 1.001);
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_NE(found.warnings[0].find("jumps from 70 to 40"), std::string::npos);
}

TEST(bisect, says_when_no_growth_needs_fewer) {
  const Found found = search({.balls = 5000}, falling);
  EXPECT_EQ(found.search.value, 0);
  EXPECT_EQ(found.search.balls, 1001);
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_NE(found.warnings[0].find("without any growth 1001 balls are enough"), std::string::npos);
}

TEST(bisect, fails_with_the_number_that_the_largest_growth_needs) {
  const BisectOptions options{.balls = 5, .largest = 8};
  Bisection state = begin_bisection(options);
  try {
    for (int i = 0; i < 100; ++i) state = bisect(state, cover_of(falling(state.value)), options);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("growth by 8.0"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(std::to_string(falling(8)) + " balls, not 5"), std::string::npos)
        << error.what();
  }
}

TEST(bisect, never_ends_above_k_although_pruning_is_not_monotone) {
  const auto noisy = [](double growth) {
    return falling(growth) + static_cast<std::int64_t>(growth * 1e6) % 7;
  };
  for (const std::int64_t k : {20, 90, 300}) search({.balls = k, .tolerance = 0.01}, noisy);
}

TEST(bisect, leaves_a_search_that_is_done_as_it_is) {
  const Found found = search({.balls = 100}, falling);
  const Bisection after = bisect(found.search, cover_of(3), {.balls = 100});
  EXPECT_EQ(after.value, found.search.value);
  EXPECT_EQ(after.tried, found.search.tried);
}

TEST(bisect, refuses_what_makes_no_sense) {
  EXPECT_THROW(begin_bisection({.balls = 0}), InputError);
  EXPECT_THROW(begin_bisection({.tolerance = 1}), InputError);
  EXPECT_THROW(begin_bisection({.start = 0}), InputError);
  EXPECT_THROW(begin_bisection({.start = 2, .largest = 1}), InputError);
  CoverState unfinished = cover_of(2);
  unfinished.row_offsets = {0, 1};
  unfinished.columns = {0};
  unfinished.row_ids = {0};
  unfinished.column_ids = {0};
  ASSERT_NE(unfinished.remaining(), 0);
  EXPECT_THROW(bisect(begin_bisection({}), unfinished, {}), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
