// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/model/growth.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::codegen {
namespace {

void absorb(Term& result, const Term& operand) {
  result.constant = result.constant && operand.constant;
  result.depth = std::max(result.depth, operand.depth + 1);
  result.size += operand.size;
  result.bits += operand.bits;
  result.must_be_defined.insert(result.must_be_defined.end(), operand.must_be_defined.begin(),
                                operand.must_be_defined.end());
}

void check_limits(const Term& result) {
  if (result.depth > kMostDepth)
    throw Refusal{"an expression nested too deeply",
                  "at most " + std::to_string(kMostDepth) + " levels"};
  if (result.size > kLargestSize)
    throw Refusal{"an expression too large", "at most " +
                                                 std::to_string(static_cast<int>(kLargestSize)) +
                                                 " operations, named sub-expressions included"};
  if (result.bits > kMostBits)
    throw Refusal{"numbers too large", "exact coefficients of at most " +
                                           std::to_string(static_cast<int>(kMostBits)) + " bits"};
}

}  // namespace

Term grow(const std::vector<Operand>& operands) {
  Term result;
  for (const Operand& o : operands) absorb(result, o.term);
  check_limits(result);
  return result;
}

Term grow(const std::vector<Term>& operands) {
  Term result;
  for (const Term& t : operands) absorb(result, t);
  check_limits(result);
  return result;
}

Term grow_by_power(const Term& base, const Term& exponent, const GiNaC::numeric& value) {
  Term result;
  absorb(result, base);
  absorb(result, exponent);
  result.bits = base.bits * std::max(1.0, std::fabs(value.to_double()));
  check_limits(result);
  return result;
}

}  // namespace regulus::codegen
