// Pairs of doubles: twice the bits of a double from arithmetic that is the same on every machine.
#pragma once

namespace ballflow::geometry {

/// The sum of two doubles, the second at most half a unit in the last place of the first: about 106 bits.
///
/// Errors are below 2^-103 (|a| + |b|) for a + b and a - b, below 2^-103 |a b| for a b, and below
/// 2^-100 |a / b| for a / b, unless something overflows or underflows: keep factors below 1e290, and products
/// that matter above 1e-290 [Dekker 1971; Joldes, Muller and Popescu 2017]. Needs double arithmetic that
/// rounds to nearest and fuses nothing (-ffp-contract=off).
struct DoubleDouble {
  double high = 0, low = 0;

  static DoubleDouble sum(double a, double b) {  // exact
    const double high = a + b, part = high - a;
    return {high, (a - (high - part)) + (b - part)};
  }
  static DoubleDouble product(double a, double b) {  // exact
    const auto halves = [](double x) {
      const double shifted = 134217729 * x, upper = shifted - (shifted - x);
      return DoubleDouble{upper, x - upper};
    };
    const DoubleDouble x = halves(a), y = halves(b);
    const double high = a * b;
    return {high, ((x.high * y.high - high) + x.high * y.low + x.low * y.high) + x.low * y.low};
  }
  friend DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
    const DoubleDouble s = sum(a.high, b.high);
    return sum(s.high, s.low + (a.low + b.low));
  }
  friend DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + DoubleDouble{-b.high, -b.low}; }
  friend DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
    const DoubleDouble p = product(a.high, b.high);
    return sum(p.high, p.low + (a.high * b.low + a.low * b.high));
  }
  friend DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
    const double first = a.high / b.high;
    const DoubleDouble left = a - b * DoubleDouble{first};
    const double second = left.high / b.high;
    const double third = (left - b * DoubleDouble{second}).high / b.high;
    return sum(first, second) + DoubleDouble{third};
  }
};

/// The nearest double.
inline double nearest(double a) { return a; }
inline double nearest(DoubleDouble a) { return a.high; }

/// The difference of two doubles as a Real: rounded, or exact.
template <class Real>
Real difference_of(double a, double b);
template <>
inline double difference_of<double>(double a, double b) {
  return a - b;
}
template <>
inline DoubleDouble difference_of<DoubleDouble>(double a, double b) {
  return DoubleDouble::sum(a, -b);
}

}  // namespace ballflow::geometry
