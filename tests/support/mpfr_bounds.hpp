// SPDX-License-Identifier: GPL-3.0-or-later
// Encloses exact results of operations on doubles between two adjacent doubles, by MPFR.
#pragma once

#include <mpfr.h>

namespace regulus::detail::test {

/// The greatest double ≤ the exact value and the least ≥ it: −∞, ±max, ∞ and subnormals included.
struct Tightest {
  double lo, hi;
};

/// An MPFR number. Its exponents are practically unbounded, so nothing overflows or underflows
/// before the conversion to double, which rounds in the same direction.
class MpfrNumber {
 public:
  explicit MpfrNumber(mpfr_prec_t precision = 53) { mpfr_init2(value_, precision); }
  ~MpfrNumber() { mpfr_clear(value_); }
  MpfrNumber(const MpfrNumber&) = delete;
  MpfrNumber& operator=(const MpfrNumber&) = delete;

  operator mpfr_ptr() { return value_; }
  /// Assigns exactly: 53 bits hold a double.
  MpfrNumber& operator=(double x) {
    mpfr_set_d(value_, x, MPFR_RNDN);
    return *this;
  }

 private:
  mpfr_t value_;
};

/// Ensures   the tightest doubles around the exact value that `compute(result, rounding)` rounds.
/// Requires  `compute` rounds correctly, as MPFR's functions do. A precision of 53 bits is enough:
///           rounding down to 53 bits and then down to a subnormal is the same as rounding down
///           in one step.
template <class Compute>
Tightest tightest(MpfrNumber& result, Compute compute) {
  compute(static_cast<mpfr_ptr>(result), MPFR_RNDD);
  const double lo = mpfr_get_d(result, MPFR_RNDD);
  compute(static_cast<mpfr_ptr>(result), MPFR_RNDU);
  return {lo, mpfr_get_d(result, MPFR_RNDU)};
}

}  // namespace regulus::detail::test
