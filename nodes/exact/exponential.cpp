#include "exact/exponential.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace ballflow::geometry {
namespace {

// The first part of ln 2 ends in 21 bits of zeros, so that its products with exponents are exact.
constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// 2^k of a normal double.
double power_of_two(std::int64_t k) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

}  // namespace

double exponential(double x) {
  constexpr double log2_e = 0x1.71547652b82fep+0;
  if (!(x > -746)) return std::isnan(x) ? x : 0;
  if (x > 709.8) return infinity;
  const double turns = x * log2_e;
  const auto k = static_cast<std::int64_t>(turns < 0 ? turns - 0.5 : turns + 0.5);
  const auto t = static_cast<double>(k);
  const double high = x - t * ln2_high, r = high - t * ln2_low;  // at most .35
  // The series up to r^13 / 13!, in pairs of terms: short chains of operations. The first term of it stands
  // apart, since the others are small beside it.
  const double r2 = r * r, r4 = r2 * r2;
  const double a = 1.0 / 2 + r * (1.0 / 6), b = 1.0 / 24 + r * (1.0 / 120);
  const double c = 1.0 / 720 + r * (1.0 / 5040), d = 1.0 / 40320 + r * (1.0 / 362880);
  const double e = 1.0 / 3628800 + r * (1.0 / 39916800), f = 1.0 / 479001600 + r * (1.0 / 6227020800);
  const double tail = (a + r2 * b) + r4 * ((c + r2 * d) + r4 * (e + r2 * f));
  const double value = 1 + (r + r2 * tail);
  if (k >= -1021 && k <= 1022) return value * power_of_two(k);
  return k > 0 ? value * power_of_two(k - 1) * 2 : value * power_of_two(k + 100) * 0x1p-100;
}

double logarithm(double x) {
  if (!(x > 0)) return x == 0 ? -infinity : std::numeric_limits<double>::quiet_NaN();
  if (x == infinity) return x;
  std::int64_t exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<std::int64_t>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0xfffffffffffffull) | 0x3ff0000000000000ull);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++exponent;
  }
  // log m = 2 artanh(f) with f = (m - 1) / (m + 1), at most .172. What m - 1 is above 2 f is f (m - 1).
  const double g = m - 1, f = g / (m + 1), f2 = f * f;
  double series = 1.0 / 23;
  for (int k = 21; k >= 3; k -= 2) series = 1.0 / k + f2 * series;
  const double tail = 2 * f2 * series;
  const auto t = static_cast<double>(exponent);
  return t * ln2_high + (g - (f * (g - tail) - t * ln2_low));
}

}  // namespace ballflow::geometry
