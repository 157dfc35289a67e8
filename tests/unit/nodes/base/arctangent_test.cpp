#include "base/arctangent.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ballflow::geometry {
namespace {

TEST(cosine, is_that_of_the_library_up_to_rounding) {
  for (int i = 0; i <= 10000; ++i) {
    const double angle = pi * i / 10000;
    ASSERT_NEAR(cosine(angle), std::cos(angle), 1e-15) << angle;
  }
  EXPECT_EQ(cosine(0), 1);
}

}  // namespace
}  // namespace ballflow::geometry
