// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/parsed_expression.hpp"

#include <cln/integer.h>

#include <algorithm>
#include <string>
#include <utility>

#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/combine_limits.hpp"
#include "codegen/model/exact/domain.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

bool is_rational(const ex& e) { return e.info(GiNaC::info_flags::rational); }

/// True if the denominator is a power of two: then the power consists of square roots.
bool is_dyadic(const numeric& exponent) {
  const cln::cl_I denominator = cln::the<cln::cl_I>(exponent.denom().to_cl_N());
  return cln::logcount(denominator) == 1 && denominator <= kMaxRootDenominator;
}

numeric checked_exponent(const ParsedExpression& exponent) {
  if (!exponent.constant || !is_rational(exponent.value))
    throw ParseRefusal{"an exponent that is not a rational constant", "an integer or a fraction"};
  const numeric& value = GiNaC::ex_to<numeric>(exponent.value);
  if (GiNaC::abs(value) > kLargestPower)
    throw ParseRefusal{"an exponent beyond ±" + std::to_string(kLargestPower),
                       "a smaller exponent"};
  return value;
}

/// GiNaC merges powers: (x^100)^100 is x^10000. Stages that follow count exponents in an int.
const ex& with_moderate_exponents(const ex& value) {
  const auto check = [](const ex& factor) {
    if (!GiNaC::is_a<GiNaC::power>(factor) || !is_rational(factor.op(1))) return;
    if (GiNaC::abs(GiNaC::ex_to<numeric>(factor.op(1))) > kMaxMergedPower)
      throw ParseRefusal{"powers that make an exponent beyond ±" + std::to_string(kMaxMergedPower),
                         "smaller exponents"};
  };
  check(value);
  if (GiNaC::is_a<GiNaC::mul>(value)) std::for_each(value.begin(), value.end(), check);
  return value;
}

/// Returns x^(p/q) for x > 0, if q is not a power of two.
ex fractional_power(ParsedExpression& result, const ParsedExpression& base,
                    const numeric& exponent) {
  require_positive(result, base.value, base.constant);
  if (is_rational(base.value)) {
    const ex root = GiNaC::pow(base.value, exponent);
    if (is_rational(root)) return root;
  }
  return GiNaC::exp(exponent * GiNaC::log(base.value));
}

}  // namespace

ParsedExpression number(const numeric& value) {
  ParsedExpression result{.value = value};
  result.bits = value.numer().int_length() + value.denom().int_length();
  return result;
}

ParsedExpression constant(const ex& value) { return ParsedExpression{.value = value}; }

ParsedExpression variable(const GiNaC::realsymbol& symbol) {
  return ParsedExpression{.value = symbol, .constant = false};
}

ParsedExpression angle_in_degrees(const GiNaC::realsymbol& symbol) {
  return {
      .value = symbol * one_degree(), .constant = false, .size = 3, .is_angle_in_degrees = true};
}

ParsedExpression sum(std::vector<Operand> operands) {
  ParsedExpression result = combine_limits(operands);
  GiNaC::exvector terms;
  terms.reserve(operands.size());
  for (const Operand& o : operands) terms.push_back(o.inverted ? -o.term.value : o.term.value);
  result.value = GiNaC::add(terms);
  return result;
}

ParsedExpression product(std::vector<Operand> operands) {
  ParsedExpression result = combine_limits(operands);
  GiNaC::exvector factors;
  factors.reserve(operands.size());
  for (const Operand& o : operands) {
    if (o.inverted) require_nonzero(result, o.term.value, o.term.constant);
    factors.push_back(o.inverted ? GiNaC::pow(o.term.value, -1) : o.term.value);
  }
  result.value = with_moderate_exponents(GiNaC::mul(factors));
  return result;
}

ParsedExpression power(const ParsedExpression& base, const ParsedExpression& exponent) {
  const numeric n = checked_exponent(exponent);
  ParsedExpression result = combine_limits_of_power(base, exponent, n);
  if (n.is_negative() || (n.is_zero() && base.value.is_zero()))
    require_nonzero(result, base.value, base.constant);
  if (!is_dyadic(n)) {
    result.value = fractional_power(result, base, n);
    return result;
  }
  if (!n.is_integer()) require_nonnegative(result, base.value, base.constant);
  result.value = with_moderate_exponents(GiNaC::pow(base.value, n));
  return result;
}

}  // namespace regulus::detail
