// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/rational_arithmetic.hpp"

#include <cln/integer.h>

#include "codegen/kernel/program/fold.hpp"

namespace regulus::detail {
namespace {

bool in_domain(Op function, const cln::cl_RA& a) {
  switch (function) {
    case Op::kSqrt:
      return !cln::minusp(a);
    case Op::kLog:
      return cln::plusp(a);
    case Op::kAsin:
    case Op::kAcos:
      return cln::abs(a) <= 1;
    default:
      return true;  // tan has its poles at irrational arguments
  }
}

}  // namespace

cln::cl_RA RationalArithmetic::divide(const Number& a, const Number& b) const {
  if (cln::zerop(b)) throw UndefinedValue("division by zero");
  return a / b;
}

cln::cl_RA RationalArithmetic::power(const Number& a, unsigned exponent) const {
  return cln::expt(a, static_cast<cln::cl_I>(static_cast<unsigned long>(exponent)));
}

cln::cl_RA RationalArithmetic::atan2(const Number& a, const Number& b) const {
  if (!cln::zerop(a)) throw NotRational("atan2");
  if (!cln::plusp(b)) throw UndefinedValue("atan2 on its cut");
  return 0;
}

cln::cl_RA RationalArithmetic::call(Op function, const Number& a) const {
  if (!in_domain(function, a)) throw UndefinedValue(op_name(function));
  if (const auto value = fold_call(function, a)) return *value;
  throw NotRational(op_name(function));
}

}  // namespace regulus::detail
