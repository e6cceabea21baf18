// SPDX-License-Identifier: Apache-2.0
#include "regulus/interval/arithmetic.hpp"

namespace regulus {
namespace {

using DirectedProduct = double (*)(double, double) noexcept;

/// xⁿ by binary powering, each product rounded the same way.
/// Requires  x ≥ 0, n ≥ 1. Products of nonnegative bounds on one side stay bounds on that side.
double directed_power(double x, unsigned n, DirectedProduct product) noexcept {
  double square = x;
  double result = 1;
  for (;; square = product(square, square)) {
    if (n & 1) result = product(result, square);
    n >>= 1;
    if (n == 0) return result;
  }
}

double power_rd(double x, unsigned n) noexcept { return directed_power(x, n, mul_rd); }
double power_ru(double x, unsigned n) noexcept { return directed_power(x, n, mul_ru); }

Interval positive_power(Interval x, unsigned n) noexcept {
  if (n % 2 == 0) return {power_rd(mig(x), n), power_ru(mag(x), n)};
  return {x.lo >= 0 ? power_rd(x.lo, n) : -power_ru(-x.lo, n),
          x.hi >= 0 ? power_ru(x.hi, n) : -power_rd(-x.hi, n)};
}

}  // namespace

Interval pow(Interval x, int n, bool& undefined) noexcept {
  if (n == 0) return 1.0;
  if (n > 0) return positive_power(x, static_cast<unsigned>(n));
  if (contains_zero(x)) {
    undefined = true;
    return kEntire;
  }
  // A power that underflows is a denominator that possibly is 0, but xⁿ itself is defined: its
  // reciprocal is then unbounded on that side.
  const Interval denominator = positive_power(x, 0u - static_cast<unsigned>(n));
  if (denominator.lo == 0) return {div_rd(1, denominator.hi), kInfinity};
  if (denominator.hi == 0) return {-kInfinity, div_ru(1, denominator.lo)};
  return div(1.0, denominator, undefined);
}

Interval pow(Interval x, int n) noexcept {
  bool undefined = false;
  return pow(x, n, undefined);
}

}  // namespace regulus
