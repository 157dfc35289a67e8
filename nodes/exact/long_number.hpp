// Numbers of any length that know how wrong they may be.
#pragma once

#include <mpfr.h>

#include <utility>

namespace ballflow::geometry {

/// A number in as many bits as wanted with a bound of its error: the value meant lies within `error` of the
/// one that is stored. Every operation rounds to the longer of its operands and adds up what may have been
/// lost (bounds are rounded upwards), so that a sign that is told is right. Exponents do not overflow for any
/// expression in doubles (MPFR).
class LongNumber {
 public:
  /// A double, exactly. `bits`: at least 64.
  LongNumber(double value, long bits);
  /// factor * 2^exponent, exactly.
  static LongNumber scaled(double factor, long exponent, long bits);

  LongNumber(const LongNumber& other);
  LongNumber(LongNumber&& other) noexcept;
  LongNumber& operator=(LongNumber other) noexcept {
    swap(other);
    return *this;
  }
  ~LongNumber();

  /// -1 or 1 where the error leaves no doubt; else 0, also for an exact 0.
  int sign() const;
  /// Whether the value is known to `bits` bits, or to 2^exponent.
  bool known_to(long bits, long exponent) const;
  double nearest() const;  // the double next to the stored value
  /// Doubles that enclose the value meant.
  std::pair<double, double> interval() const;

  friend LongNumber operator+(const LongNumber& a, const LongNumber& b);
  friend LongNumber operator-(const LongNumber& a, const LongNumber& b);
  friend LongNumber operator*(const LongNumber& a, const LongNumber& b);
  /// The error is infinite where the divisor may be 0.
  friend LongNumber operator/(const LongNumber& a, const LongNumber& b);
  /// Of a value that is not negative; what of the interval of `a` is, counts as 0.
  friend LongNumber square_root(const LongNumber& a);

 private:
  struct Bits {
    long count;
  };
  explicit LongNumber(Bits bits);  // neither value nor error set
  static LongNumber like(const LongNumber& a, const LongNumber& b);
  void swap(LongNumber& other) noexcept;
  void add_rounding(int inexact);

  mpfr_t value_, error_;
};

}  // namespace ballflow::geometry
