// SPDX-License-Identifier: Apache-2.0
// Exact answers about polynomials in one variable, over a range with rational ends.
#pragma once

#include <fmpq_poly.h>

#include "runtime/verifier/polynomial.hpp"

namespace regulus::verifier {

class Univariate {
 public:
  Univariate() noexcept { fmpq_poly_init(value_); }
  Univariate(const Univariate& other) noexcept : Univariate() {
    fmpq_poly_set(value_, other.value_);
  }
  Univariate& operator=(const Univariate& other) noexcept {
    fmpq_poly_set(value_, other.value_);
    return *this;
  }
  ~Univariate() { fmpq_poly_clear(value_); }

  /// Returns false if p has another atom, a negative exponent, or is too large; value is then 0.
  [[nodiscard]] bool set(const Polynomial& p, int atom);
  void subtract(const Rational& constant);

  [[nodiscard]] Rational at(const Rational& x) const;
  /// Requires  lo ≤ hi.
  /// Ensures   true only if p(x) ≠ 0 for all x in [lo, hi].
  [[nodiscard]] bool has_no_root(const Rational& lo, const Rational& hi) const;
  /// Ensures   true only if p(x) ≤ 0 for all x in [0, 1].
  [[nodiscard]] bool is_nonpositive_on_unit() const;

 private:
  fmpq_poly_t value_;
};

}  // namespace regulus::verifier
