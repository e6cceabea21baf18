// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/univariate.hpp"

#include <fmpz_poly.h>

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostBitsOfSequence =
    1 << 18;  ///< degree times digits; Sturm's sequence grows with it

/// Counts roots strictly between 0 and 1. `p` is squarefree, and not 0 at 0 or 1.
long roots_inside_unit(const fmpz_poly_t p) {
  fmpz_poly_t turned;
  fmpz_poly_init(turned);
  // t = 1/(1 + s) maps the positive s to the t of (0, 1).
  fmpz_poly_reverse(turned, p, fmpz_poly_length(p));
  fmpz_t one;
  fmpz_init_set_ui(one, 1);
  fmpz_poly_taylor_shift(turned, turned, one);
  fmpz_clear(one);
  slong negative = 0, positive = 0;
  if (fmpz_poly_degree(turned) > 0)
    _fmpz_poly_num_real_roots_sturm(&negative, &positive, turned->coeffs, turned->length);
  fmpz_poly_clear(turned);
  return positive;
}

/// Does the same for any p that is not 0 at 0 and 1; changes p.
long distinct_roots_inside_unit(fmpq_poly_t p) {
  fmpz_poly_t whole, derivative;
  fmpz_poly_init(whole), fmpz_poly_init(derivative);
  fmpq_poly_get_numerator(whole, p);
  fmpz_poly_derivative(derivative, whole);
  if (!fmpz_poly_is_zero(derivative)) {
    fmpz_poly_gcd(derivative, whole, derivative);
    fmpz_poly_div(whole, whole, derivative);
  }
  const long roots = roots_inside_unit(whole);
  fmpz_poly_clear(whole), fmpz_poly_clear(derivative);
  return roots;
}

}  // namespace

bool Univariate::set(const Polynomial& p, int atom) {
  fmpq_poly_zero(value_);
  std::size_t bits = 1, degree = 1;
  for (const auto& [powers, factor] : p.terms()) {
    if (powers.size() > 1 ||
        (powers.size() == 1 && (powers[0].first != atom || powers[0].second < 0)))
      return false;
    bits = std::max(bits, factor.bits());
    if (!powers.empty()) degree = std::max(degree, std::size_t(powers[0].second));
  }
  if (bits * degree * degree > kMostBitsOfSequence) return false;
  for (const auto& [powers, factor] : p.terms())
    fmpq_poly_set_coeff_fmpq(value_, powers.empty() ? 0 : powers[0].second, factor.get());
  return true;
}

void Univariate::subtract(const Rational& constant) {
  Rational value;
  fmpq_poly_get_coeff_fmpq(value.get(), value_, 0);
  fmpq_poly_set_coeff_fmpq(value_, 0, (value - constant).get());
}

Rational Univariate::at(const Rational& x) const {
  Rational result;
  fmpq_poly_evaluate_fmpq(result.get(), value_, x.get());
  return result;
}

bool Univariate::has_no_root(const Rational& lo, const Rational& hi) const {
  if (at(lo).is_zero() || at(hi).is_zero()) return false;
  if (lo == hi) return true;
  fmpq_poly_t line, moved;
  fmpq_poly_init(line), fmpq_poly_init(moved);
  fmpq_poly_set_coeff_fmpq(line, 0, lo.get());
  fmpq_poly_set_coeff_fmpq(line, 1, (hi - lo).get());
  fmpq_poly_compose(moved, value_, line);
  const long roots = distinct_roots_inside_unit(moved);
  fmpq_poly_clear(line), fmpq_poly_clear(moved);
  return roots == 0;
}

/// Shows that p = t^a·(1 − t)^b·r, where r is negative on all of [0, 1].
bool Univariate::is_nonpositive_on_unit() const {
  if (fmpq_poly_is_zero(value_) != 0) return true;
  Univariate rest(*this);
  const auto divide_by = [&rest](const Rational& root, long slope) {
    fmpq_poly_t factor;
    fmpq_poly_init(factor);
    fmpq_poly_set_coeff_fmpq(factor, 0, (root * Rational(-slope)).get());
    fmpq_poly_set_coeff_si(factor, 1, slope);
    while (rest.at(root).is_zero()) fmpq_poly_div(rest.value_, rest.value_, factor);
    fmpq_poly_clear(factor);
  };
  divide_by(Rational(0), 1);
  divide_by(Rational(1), -1);
  return rest.at(Rational(0)).sign() < 0 && rest.has_no_root(Rational(0), Rational(1));
}

}  // namespace regulus::verifier
