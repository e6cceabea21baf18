// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/combine_limits.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

void absorb(ParsedExpression& result, const ParsedExpression& operand) {
  result.constant = result.constant && operand.constant;
  result.depth = std::max(result.depth, operand.depth + 1);
  result.size += operand.size;
  result.bits += operand.bits;
  result.must_be_defined.insert(result.must_be_defined.end(), operand.must_be_defined.begin(),
                                operand.must_be_defined.end());
}

void check_limits(const ParsedExpression& result) {
  if (result.depth > kMostDepth)
    throw ParseRefusal{"an expression nested too deeply",
                       "at most " + std::to_string(kMostDepth) + " levels"};
  if (result.size > kLargestSize)
    throw ParseRefusal{"an expression too large",
                       "at most " + std::to_string(static_cast<int>(kLargestSize)) +
                           " operations, named sub-expressions included"};
  if (result.bits > kMostBits)
    throw ParseRefusal{
        "numbers too large",
        "exact coefficients of at most " + std::to_string(static_cast<int>(kMostBits)) + " bits"};
}

}  // namespace

ParsedExpression combine_limits(const std::vector<Operand>& operands) {
  ParsedExpression result;
  for (const Operand& o : operands) absorb(result, o.term);
  check_limits(result);
  return result;
}

ParsedExpression combine_limits(const std::vector<ParsedExpression>& operands) {
  ParsedExpression result;
  for (const ParsedExpression& t : operands) absorb(result, t);
  check_limits(result);
  return result;
}

ParsedExpression combine_limits_of_power(const ParsedExpression& base,
                                         const ParsedExpression& exponent,
                                         const GiNaC::numeric& value) {
  ParsedExpression result;
  absorb(result, base);
  absorb(result, exponent);
  result.bits = base.bits * std::max(1.0, std::fabs(value.to_double()));
  check_limits(result);
  return result;
}

}  // namespace regulus::detail
