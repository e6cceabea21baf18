// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/oracle/rational.hpp"

#include <cmath>
#include <stdexcept>

namespace regulus::detail::attack {

Rational Rational::integer(std::string_view digits, int base) {
  Rational r;
  if (fmpz_set_str(fmpq_numref(r.q_), std::string(digits).c_str(), base) != 0)
    throw std::invalid_argument("not an integer: " + std::string(digits));
  return r;
}

Rational Rational::decimal(std::string_view digits, long exponent) {
  return integer(digits, 10) * ten_to(exponent);
}

Rational Rational::of(double value) {
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(value, &exponent), 53);
  return Rational(static_cast<long>(mantissa)) * two_to(exponent - 53);
}

Rational Rational::to_the(long exponent) const {
  Rational r;
  fmpq_pow_si(r.q_, q_, exponent);
  return r;
}

std::string Rational::fraction() const {
  char* text = fmpq_get_str(nullptr, 10, q_);
  std::string result(text);
  flint_free(text);
  return result;
}

}  // namespace regulus::detail::attack
