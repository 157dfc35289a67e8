#include "exact/long_number.hpp"

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace ballflow::geometry {
namespace {

TEST(long_number, tells_the_sign_of_what_doubles_lose) {
  const LongNumber one(1, 512), tiny = LongNumber::scaled(1, -300, 512);
  EXPECT_EQ(((one + tiny) - one).sign(), 1);
  EXPECT_EQ((one - (one + tiny)).sign(), -1);
  EXPECT_EQ((one - one).sign(), 0);
}

TEST(long_number, does_not_tell_a_sign_that_it_has_lost_itself) {
  const LongNumber one(1, 128), tiny = LongNumber::scaled(1, -300, 128);
  EXPECT_EQ(((one + tiny) - one).sign(), 0);
}

TEST(long_number, never_takes_the_square_of_a_root_for_another_number) {
  for (long bits = 64; bits < 5000; bits *= 3) {
    const LongNumber root = square_root(LongNumber(2, bits));
    EXPECT_EQ((root * root - LongNumber(2, bits)).sign(), 0) << bits;
    EXPECT_EQ((root * root - LongNumber(2.0000000001, bits)).sign(), -1) << bits;
    EXPECT_TRUE(root.known_to(bits - 8, -100000)) << bits;
  }
}

TEST(long_number, knows_nothing_of_a_quotient_by_what_may_be_zero) {
  const LongNumber one(1, 128), lost = (one + LongNumber::scaled(1, -300, 128)) - one;
  EXPECT_FALSE((one / lost).known_to(1, 1000));
  EXPECT_EQ((one / lost).sign(), 0);
}

TEST(long_number, of_a_root_of_what_may_be_negative_is_near_zero) {
  const LongNumber one(1, 128), lost = (one + LongNumber::scaled(1, -300, 128)) - one;
  const LongNumber root = square_root(lost);
  EXPECT_EQ(root.sign(), 0);
  EXPECT_TRUE(root.known_to(1000, -60));
}

TEST(long_number, encloses_what_rational_numbers_say) {
  using Rational = CGAL::Exact_rational;
  std::mt19937_64 engine(1);
  const auto random = [&engine] {
    return std::ldexp(static_cast<double>(engine() >> 11) - 0x1p52, static_cast<int>(engine() % 200) - 150);
  };
  for (int i = 0; i < 2000; ++i) {
    const double a = random(), b = random(), c = random(), d = i % 3 == 0 ? a : random();
    const long bits = 64 + static_cast<long>(engine() % 100);
    // Of the type of the numbers: an expression template would outlive what it refers to.
    const auto value = [&](auto of) -> decltype(of(a)) {
      return (of(a) * of(b) - of(c) / of(d)) * (of(d) - of(a)) + of(c) * of(b);
    };
    const Rational exact = value([](double x) { return Rational(x); });
    const LongNumber found = value([&](double x) { return LongNumber(x, bits); });
    const auto [low, high] = found.interval();
    EXPECT_LE(Rational(low), exact);
    EXPECT_GE(Rational(high), exact);
    EXPECT_TRUE(found.sign() == 0 || found.sign() == static_cast<int>(CGAL::sign(exact)));
  }
}

}  // namespace
}  // namespace ballflow::geometry
