#include "enclose/allocate_balls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

/// Volumes outside of c / sqrt(k), which the interpolation reproduces.
std::vector<EnclosureFit> fits_of(const std::vector<double>& objects) {
  std::vector<EnclosureFit> fits;
  for (const double c : objects) {
    for (const std::int64_t k : {2, 8, 32}) {
      EnclosureFit fit;
      fit.wanted = k;
      fit.loss = c / std::sqrt(static_cast<double>(k));
      fits.push_back(fit);
    }
  }
  return fits;
}

std::vector<std::int32_t> allocated(const std::vector<double>& objects, const AllocateBallsOptions& options) {
  const BallCounts counts = allocate_balls(fits_of(objects), options);
  return {counts.counts.begin(), counts.counts.end()};
}

TEST(allocate_balls, is_the_best_of_all_ways_to_hand_them_out) {
  constexpr int total = 24;
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::int32_t> best;
  for (int a = 1; a < total; ++a) {
    for (int b = 1; a + b < total; ++b) {
      const double outside = 1 / std::sqrt(a) + 3 / std::sqrt(b) + 7 / std::sqrt(total - a - b);
      if (outside >= least) continue;
      least = outside;
      best = {a, b, total - a - b};
    }
  }
  AllocateBallsOptions options;
  options.balls = total;
  EXPECT_EQ(allocated({1, 3, 7}, options), best);
  const BallCounts counts = allocate_balls(fits_of({1, 3, 7}), options);
  EXPECT_NEAR(counts.outside[0] + counts.outside[1] + counts.outside[2], least, 1e-12);
}

TEST(allocate_balls, keeps_minima_and_fixed_counts_and_looks_at_weights) {
  AllocateBallsOptions options;
  options.balls = 40;
  options.minimum = 6;
  options.fixed = {0, 9, 0};
  EXPECT_EQ(allocated({0.01, 100, 1}, options), (std::vector<std::int32_t>{6, 9, 25}));
  options.fixed = {};
  options.weights = {1000, 0, 0};
  EXPECT_EQ(allocated({0.01, 100, 1}, options), (std::vector<std::int32_t>{28, 6, 6}));
  options.fixed = {1, 2, 3};  // fewer than there are: nobody takes the rest
  EXPECT_EQ(allocated({0.01, 100, 1}, options), (std::vector<std::int32_t>{1, 2, 3}));
}

TEST(allocate_balls, a_fit_without_luck_does_not_end_the_gains_of_an_object) {
  std::vector<EnclosureFit> fits = fits_of({7, 3});
  fits[1].loss = fits[0].loss;  // 8 balls are no better than 2
  AllocateBallsOptions options;
  options.balls = 40;
  const BallCounts found = allocate_balls(fits, options), lucky = allocate_balls(fits_of({7, 3}), options);
  EXPECT_EQ(found.counts[0], lucky.counts[0]);
}

TEST(allocate_balls, refuses_what_does_not_add_up) {
  const auto cause = [](const AllocateBallsOptions& options) -> std::string {
    try {
      allocated({1, 2, 3}, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  AllocateBallsOptions few, weights, fixed;
  few.balls = 2;
  weights.weights = {1, 2};
  fixed.fixed = {1};
  EXPECT_NE(cause(few).find("need 3 balls"), std::string::npos);
  EXPECT_NE(cause(weights).find("2 weights for 3 objects"), std::string::npos);
  EXPECT_NE(cause(fixed).find("1 fixed counts for 3 objects"), std::string::npos);
}

TEST(allocate_balls, one_count_is_taken_out_of_several) {
  const BallCounts counts{std::vector<std::int32_t>{4, 7}, std::vector<double>{1, 2}};
  EXPECT_EQ(only_count(count_of(counts, 1)), 7);
  EXPECT_THROW(count_of(counts, 2), InputError);
  EXPECT_THROW(only_count(counts), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
