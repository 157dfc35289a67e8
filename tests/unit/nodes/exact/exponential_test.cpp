#include "exact/exponential.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.hpp"

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How far a value is from the one of the wider long double functions, relative to it.
double relative_error(double value, long double truth) {
  return static_cast<double>(std::abs((static_cast<long double>(value) - truth) / truth));
}

TEST(exponential, is_right_to_the_last_place_over_its_whole_range) {
  Random random(1);
  for (int i = 0; i < 50000; ++i) {
    const double x = i % 2 == 0 ? -708 + 1417 * random.unit() : -1 + 2 * random.unit();
    EXPECT_LT(relative_error(exponential(x), std::exp(static_cast<long double>(x))), 2e-16) << x;
  }
}

TEST(exponential, has_its_limits) {
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-1e-30), 1);
  EXPECT_EQ(exponential(-infinity), 0);
  EXPECT_EQ(exponential(infinity), infinity);
  EXPECT_EQ(exponential(-800), 0);
  EXPECT_EQ(exponential(710), infinity);
  EXPECT_TRUE(std::isnan(exponential(std::nan(""))));
  EXPECT_LT(relative_error(exponential(709.75), std::exp(709.75L)), 2e-16);
  // Subnormal numbers are multiples of 2^-1074.
  for (const double x : {-709.0, -720.5, -744.0})
    EXPECT_NEAR(exponential(x) / 0x1p-1074,
                static_cast<double>(std::exp(static_cast<long double>(x)) * 0x1p1074L), 1);
}

TEST(logarithm, is_right_to_the_last_place_over_its_whole_range) {
  Random random(2);
  for (int i = 0; i < 50000; ++i) {
    const double x = i % 2 == 0 ? std::ldexp(1 + random.unit(), static_cast<int>(2000 * random.unit()) - 1000)
                                : 0.5 + random.unit();
    EXPECT_LT(relative_error(logarithm(x), std::log(static_cast<long double>(x))), 3e-16) << x;
  }
}

TEST(logarithm, has_its_limits) {
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_EQ(logarithm(0), -infinity);
  EXPECT_EQ(logarithm(infinity), infinity);
  EXPECT_TRUE(std::isnan(logarithm(-1)));
  EXPECT_TRUE(std::isnan(logarithm(std::nan(""))));
  EXPECT_LT(relative_error(logarithm(0x1p-1074), std::log(0x1p-1074L)), 3e-16);
  EXPECT_LT(relative_error(logarithm(1 + 0x1p-52), std::log1p(0x1p-52L)), 3e-16);
  EXPECT_LT(relative_error(logarithm(1 - 0x1p-53), std::log1p(-0x1p-53L)), 3e-16);
}

}  // namespace
}  // namespace ballflow::geometry
