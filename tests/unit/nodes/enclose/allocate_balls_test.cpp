#include "enclose/allocate_balls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "base/random.hpp"

namespace ballflow::geometry {
namespace {

/// Volumes outside of c / sqrt(k), which the interpolation reproduces.
std::vector<EnclosureFit> fits_of(const std::vector<double>& objects) {
  std::vector<EnclosureFit> fits;
  for (const double c : objects) {
    for (const std::int64_t k : {2, 8, 32}) {
      EnclosureFit fit;
      fit.wanted = fit.balls = k;
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

/// Where a few more balls gain nothing and many gain much, one after another would never get there.
TEST(allocate_balls, is_the_best_of_all_ways_over_a_plateau) {
  Random random(4);
  constexpr int total = 30;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<EnclosureFit> fits;
    for (int object = 0; object < 3; ++object) {
      double loss = 1;
      for (const std::int64_t k : {1, 2, 3, 4, 5, 8, 12, 20, 30}) {
        loss *= random.unit() < 0.5 ? 1 : random.unit();
        EnclosureFit fit;
        fit.wanted = fit.balls = k;
        fit.loss = loss;
        fits.push_back(fit);
      }
    }
    AllocateBallsOptions one;
    const auto loss = [&](std::size_t object, int k) {
      one.balls = one.minimum = k;
      return allocate_balls(std::span(fits).subspan(9 * object, 9), one).outside[0];
    };
    std::vector<std::vector<double>> losses(3, std::vector<double>(total));
    for (std::size_t i = 0; i < 3; ++i) {
      for (int k = 1; k < total; ++k) losses[i][static_cast<std::size_t>(k)] = loss(i, k);
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t a = 1; a < total; ++a) {
      for (std::size_t b = 1; a + b < total; ++b)
        least = std::min(least, losses[0][a] + losses[1][b] + losses[2][total - a - b]);
    }
    AllocateBallsOptions options;
    options.balls = total;
    const BallCounts counts = allocate_balls(fits, options);
    EXPECT_NEAR(counts.outside[0] + counts.outside[1] + counts.outside[2], least, 1e-12) << trial;
    EXPECT_LE(counts.counts[0] + counts.counts[1] + counts.counts[2], total);
  }
}

TEST(allocate_balls, very_many_go_out_in_blocks) {
  AllocateBallsOptions options;
  options.balls = 100'000;
  const std::vector<std::int32_t> counts = allocated({1, 1, 8}, options);
  EXPECT_NEAR(counts[0] + counts[1] + counts[2], options.balls, 25);
  EXPECT_NEAR(counts[2], 4 * counts[0], 200);  // equal marginal gains: k^(3/2) as c
}

TEST(allocate_balls, what_an_object_could_not_use_goes_to_others) {
  std::vector<EnclosureFit> fits = fits_of({7, 3});
  for (const std::size_t wanted : {1, 2}) {  // 8 and 32 balls: it used 5
    fits[wanted].balls = 5;
    fits[wanted].loss = 7 / std::sqrt(5.0);
  }
  AllocateBallsOptions options;
  options.balls = 40;
  const BallCounts counts = allocate_balls(fits, options);
  EXPECT_EQ(counts.counts[0], 5);
  EXPECT_EQ(counts.counts[1], 35);
  EXPECT_NEAR(counts.outside[0] + counts.outside[1], 7 / std::sqrt(5.0) + 3 / std::sqrt(35.0), 1e-12);
  fits.resize(3);  // nobody else is there
  EXPECT_EQ(allocate_balls(fits, options).counts[0], 5);
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
