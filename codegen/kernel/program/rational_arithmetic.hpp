// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cln/rational.h>

#include <stdexcept>

#include "codegen/kernel/program/program.hpp"

namespace regulus::detail {

/// The expression has no value at this point.
class UndefinedValue : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// The expression may have a value, but this arithmetic cannot represent it.
class NotRational : public std::domain_error {
 public:
  using std::domain_error::domain_error;
};

/// The interpreter's arithmetic on exact rationals. Throws UndefinedValue outside a domain, and
/// NotRational if a function's value is not known to be rational.
class RationalArithmetic {
 public:
  using Number = cln::cl_RA;

  [[nodiscard]] Number constant(const cln::cl_RA& value) const { return value; }
  [[nodiscard]] Number pi() const { throw NotRational("pi"); }
  [[nodiscard]] Number negate(const Number& a) const { return -a; }
  [[nodiscard]] Number add(const Number& a, const Number& b) const { return a + b; }
  [[nodiscard]] Number subtract(const Number& a, const Number& b) const { return a - b; }
  [[nodiscard]] Number multiply(const Number& a, const Number& b) const { return a * b; }
  [[nodiscard]] Number divide(const Number& a, const Number& b) const;
  [[nodiscard]] Number power(const Number& a, unsigned exponent) const;
  [[nodiscard]] Number atan2(const Number& a, const Number& b) const;
  [[nodiscard]] Number call(Op function, const Number& a) const;
};

}  // namespace regulus::detail
