// SPDX-License-Identifier: GPL-3.0-or-later
// Computes a rigorous bound of the error of a polynomial with double coefficients, for a series.
#pragma once

#include <arb.h>
#include <arb_poly.h>

#include <functional>
#include <span>

#include "runtime/interval/type.hpp"

namespace regulus::detail::test {

/// Writes the i-th coefficient of the series, every one at most 1 in magnitude.
using SeriesTerm = std::function<void(arb_t coefficient, slong i, slong precision)>;

/// Ensures   |x^weight·(Σ c[i]·x^i − series(x))| ≤ result for every x in the domain.
/// Requires  |x| ≤ 0.62 there.
///
/// The difference is itself a series: 128 terms, and a rest below 0.62^128/(1 − 0.62) < 2^-86. On
/// each of 256 pieces it is expanded about the middle and bounded by the magnitudes of the
/// coefficients.
class PolynomialError {
 public:
  PolynomialError(std::span<const double> c, const SeriesTerm& term, int weight) {
    arb_poly_init(difference_);
    arb_poly_init(shifted_);
    arb_init(value_);
    for (slong i = 0; i < kTerms; ++i) {
      term(value_, i, kPrecision);
      arb_neg(value_, value_);
      const auto index = static_cast<std::size_t>(i);
      if (index < c.size()) add_double(c[index]);
      arb_poly_set_coeff_arb(difference_, i + weight, value_);
    }
  }
  ~PolynomialError() {
    arb_poly_clear(difference_);
    arb_poly_clear(shifted_);
    arb_clear(value_);
  }
  PolynomialError(const PolynomialError&) = delete;
  PolynomialError& operator=(const PolynomialError&) = delete;

  double bound(Interval domain) {
    constexpr int kPieces = 256;
    const double radius = (domain.hi - domain.lo) / kPieces;  // twice the radius, for roundings
    double worst = 0;
    for (int i = 0; i < kPieces; ++i)
      worst = std::max(worst, bound_near(domain.lo + (i + 0.5) * radius, radius));
    return add_ru(worst, 0x1p-86);
  }

 private:
  static constexpr slong kTerms = 128;
  static constexpr slong kPrecision = 160;

  void add_double(double c) {
    arb_t exact;
    arb_init(exact);
    arb_set_d(exact, c);
    arb_add(value_, value_, exact, kPrecision);
    arb_clear(exact);
  }

  double bound_near(double middle, double radius) {
    arb_set_d(value_, middle);
    arb_poly_taylor_shift(shifted_, difference_, value_, kPrecision);
    mag_t sum, part, power, step;
    for (auto* m : {&sum, &part, &power, &step}) mag_init(*m);
    mag_zero(sum);
    mag_one(power);
    mag_set_d(step, radius);
    for (slong i = 0; i < arb_poly_length(shifted_); ++i) {
      arb_get_mag(part, arb_poly_get_coeff_ptr(shifted_, i));
      mag_addmul(sum, part, power);
      mag_mul(power, power, step);
    }
    const double result = mag_get_d(sum);
    for (auto* m : {&sum, &part, &power, &step}) mag_clear(*m);
    return next_up(result);
  }

  arb_poly_t difference_, shifted_;
  arb_t value_;
};

}  // namespace regulus::detail::test
