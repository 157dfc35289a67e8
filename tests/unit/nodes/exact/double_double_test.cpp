#include "exact/double_double.hpp"

#include <CGAL/Gmpq.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace ballflow::geometry {
namespace {

using Number = CGAL::Gmpq;

Number value_of(DoubleDouble a) { return Number(a.high) + Number(a.low); }

Number size_of(const Number& x) { return x < 0 ? -x : x; }

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  double operator()() {
    const double x = static_cast<double>(random_() >> 11) * 0x1p-53;
    return std::ldexp(random_() % 2 == 0 ? x : -x, static_cast<int>(random_() % 60) - 30);
  }
  DoubleDouble pair() {
    const double high = (*this)();
    return DoubleDouble::sum(high, 0x1p-54 * high * static_cast<double>(random_() % 1000) / 1000);
  }

 private:
  std::mt19937_64 random_;
};

void expect_near(DoubleDouble got, const Number& exact, const Number& size, int bits) {
  EXPECT_LE(size_of(value_of(got) - exact), size * Number(std::ldexp(1.0, -bits)))
      << got.high << " + " << got.low;
  EXPECT_EQ(got.high + got.low, got.high) << "the second is small";
}

TEST(double_double, sums_and_products_of_doubles_are_exact) {
  Numbers number(1);
  for (int round = 0; round < 10000; ++round) {
    const double a = number(), b = number();
    EXPECT_EQ(value_of(DoubleDouble::sum(a, b)), Number(a) + Number(b));
    EXPECT_EQ(value_of(DoubleDouble::product(a, b)), Number(a) * Number(b));
    EXPECT_EQ(value_of(difference_of<DoubleDouble>(a, b)), Number(a) - Number(b));
    EXPECT_EQ(difference_of<double>(a, b), a - b);
  }
}

TEST(double_double, operations_keep_twice_the_bits_of_a_double) {
  Numbers number(2);
  for (int round = 0; round < 10000; ++round) {
    const DoubleDouble a = number.pair(), b = number.pair();
    const Number x = value_of(a), y = value_of(b);
    expect_near(a + b, x + y, size_of(x) + size_of(y), 103);
    expect_near(a - b, x - y, size_of(x) + size_of(y), 103);
    expect_near(a * b, x * y, size_of(x * y), 103);
    if (y != 0) expect_near(a / b, x / y, size_of(x / y), 100);
    EXPECT_EQ(nearest(a), a.high);
  }
}

TEST(double_double, thirds_are_right_to_thirty_digits) {
  const DoubleDouble third = DoubleDouble{1} / DoubleDouble{3};
  expect_near(third, Number(1, 3), Number(1, 3), 100);
  EXPECT_EQ(nearest(third * DoubleDouble{3}), 1);
}

}  // namespace
}  // namespace ballflow::geometry
