#include "exact/long_number.hpp"

#include <algorithm>

namespace ballflow::geometry {
namespace {

constexpr mpfr_prec_t error_bits = 64;

/// A number that lives as long as a function.
struct Temporary {
  Temporary() { mpfr_init2(number, error_bits); }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() { mpfr_clear(number); }
  mpfr_t number;
};

}  // namespace

LongNumber::LongNumber(Bits bits) {
  mpfr_init2(value_, bits.count);
  mpfr_init2(error_, error_bits);
}

LongNumber::LongNumber(double value, long bits) : LongNumber(Bits{bits}) {
  mpfr_set_d(value_, value, MPFR_RNDN);
  mpfr_set_zero(error_, 1);
}

LongNumber LongNumber::scaled(double factor, long exponent, long bits) {
  LongNumber out(factor, bits);
  mpfr_mul_2si(out.value_, out.value_, exponent, MPFR_RNDN);
  return out;
}

LongNumber::LongNumber(const LongNumber& other) : LongNumber(Bits{mpfr_get_prec(other.value_)}) {
  mpfr_set(value_, other.value_, MPFR_RNDN);
  mpfr_set(error_, other.error_, MPFR_RNDU);
}

LongNumber::LongNumber(LongNumber&& other) noexcept : LongNumber(Bits{MPFR_PREC_MIN}) { swap(other); }

LongNumber::~LongNumber() {
  mpfr_clear(value_);
  mpfr_clear(error_);
}

void LongNumber::swap(LongNumber& other) noexcept {
  mpfr_swap(value_, other.value_);
  mpfr_swap(error_, other.error_);
}

LongNumber LongNumber::like(const LongNumber& a, const LongNumber& b) {
  return LongNumber(Bits{std::max(mpfr_get_prec(a.value_), mpfr_get_prec(b.value_))});
}

/// The value was rounded to the nearest: half a unit of its last place may be lost.
void LongNumber::add_rounding(int inexact) {
  if (inexact == 0 || mpfr_zero_p(value_) || !mpfr_number_p(value_)) return;
  Temporary unit;
  mpfr_set_ui_2exp(unit.number, 1, mpfr_get_exp(value_) - mpfr_get_prec(value_), MPFR_RNDU);
  mpfr_add(error_, error_, unit.number, MPFR_RNDU);
}

int LongNumber::sign() const {
  if (!mpfr_number_p(error_) || mpfr_cmpabs(value_, error_) <= 0) return 0;
  return mpfr_sgn(value_) > 0 ? 1 : -1;
}

bool LongNumber::known_to(long bits, long exponent) const {
  if (!mpfr_number_p(error_) || !mpfr_number_p(value_)) return false;
  if (mpfr_zero_p(error_) || mpfr_get_exp(error_) <= exponent) return true;
  return !mpfr_zero_p(value_) && mpfr_get_exp(error_) <= mpfr_get_exp(value_) - bits;
}

double LongNumber::nearest() const { return mpfr_get_d(value_, MPFR_RNDN); }

std::pair<double, double> LongNumber::interval() const {
  Temporary bound;
  mpfr_sub(bound.number, value_, error_, MPFR_RNDD);
  const double low = mpfr_get_d(bound.number, MPFR_RNDD);
  mpfr_add(bound.number, value_, error_, MPFR_RNDU);
  return {low, mpfr_get_d(bound.number, MPFR_RNDU)};
}

LongNumber operator+(const LongNumber& a, const LongNumber& b) {
  LongNumber out = LongNumber::like(a, b);
  const int inexact = mpfr_add(out.value_, a.value_, b.value_, MPFR_RNDN);
  mpfr_add(out.error_, a.error_, b.error_, MPFR_RNDU);
  out.add_rounding(inexact);
  return out;
}

LongNumber operator-(const LongNumber& a, const LongNumber& b) {
  LongNumber out = LongNumber::like(a, b);
  const int inexact = mpfr_sub(out.value_, a.value_, b.value_, MPFR_RNDN);
  mpfr_add(out.error_, a.error_, b.error_, MPFR_RNDU);
  out.add_rounding(inexact);
  return out;
}

LongNumber operator*(const LongNumber& a, const LongNumber& b) {
  LongNumber out = LongNumber::like(a, b);
  const int inexact = mpfr_mul(out.value_, a.value_, b.value_, MPFR_RNDN);
  mpfr_set_zero(out.error_, 1);
  if (!mpfr_zero_p(a.error_) || !mpfr_zero_p(b.error_)) {  // |a| db + (|b| + db) da
    Temporary size, part;
    mpfr_abs(size.number, a.value_, MPFR_RNDU);
    mpfr_mul(out.error_, size.number, b.error_, MPFR_RNDU);
    mpfr_abs(size.number, b.value_, MPFR_RNDU);
    mpfr_add(size.number, size.number, b.error_, MPFR_RNDU);
    mpfr_mul(part.number, size.number, a.error_, MPFR_RNDU);
    mpfr_add(out.error_, out.error_, part.number, MPFR_RNDU);
  }
  out.add_rounding(inexact);
  return out;
}

LongNumber operator/(const LongNumber& a, const LongNumber& b) {
  LongNumber out = LongNumber::like(a, b);
  Temporary least, part;  // |b| - db
  mpfr_abs(least.number, b.value_, MPFR_RNDD);
  mpfr_sub(least.number, least.number, b.error_, MPFR_RNDD);
  const int inexact = mpfr_div(out.value_, a.value_, b.value_, MPFR_RNDN);
  if (!(mpfr_sgn(least.number) > 0)) {
    mpfr_set_zero(out.value_, 1);
    mpfr_set_inf(out.error_, 1);
    return out;
  }
  // |a / b - a' / b'| <= (da + |a / b| db) / (|b| - db)
  mpfr_abs(part.number, out.value_, MPFR_RNDU);
  mpfr_nextabove(part.number);
  mpfr_mul(part.number, part.number, b.error_, MPFR_RNDU);
  mpfr_add(part.number, part.number, a.error_, MPFR_RNDU);
  mpfr_div(out.error_, part.number, least.number, MPFR_RNDU);
  out.add_rounding(inexact);
  return out;
}

LongNumber square_root(const LongNumber& a) {
  LongNumber out = LongNumber::like(a, a);
  Temporary least;  // a - da
  mpfr_sub(least.number, a.value_, a.error_, MPFR_RNDD);
  if (!(mpfr_sgn(least.number) > 0)) {  // between 0 and sqrt(a + da)
    mpfr_set_zero(out.value_, 1);
    mpfr_add(out.error_, a.value_, a.error_, MPFR_RNDU);
    if (mpfr_sgn(out.error_) < 0) mpfr_set_zero(out.error_, 1);
    mpfr_sqrt(out.error_, out.error_, MPFR_RNDU);
    return out;
  }
  const int inexact = mpfr_sqrt(out.value_, a.value_, MPFR_RNDN);
  mpfr_sqrt(least.number, least.number, MPFR_RNDD);
  mpfr_div(out.error_, a.error_, least.number, MPFR_RNDU);
  out.add_rounding(inexact);
  return out;
}

}  // namespace ballflow::geometry
