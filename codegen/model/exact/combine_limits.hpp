// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the size of the result of an operation on parsed expressions, before it is carried out.
#pragma once

#include <vector>

#include "codegen/model/exact/parsed_expression.hpp"

namespace regulus::detail {

// Each function returns a ParsedExpression with the limits of the result but without its value, and
// throws ParseRefusal if it would exceed a limit of parsed_expression.hpp. Coefficients of a sum or
// product have at most the bits of all operands together, those of a power |exponent| times as
// many.

[[nodiscard]] ParsedExpression combine_limits(const std::vector<Operand>& operands);
[[nodiscard]] ParsedExpression combine_limits(const std::vector<ParsedExpression>& operands);
/// `value` is the value of the exponent.
[[nodiscard]] ParsedExpression combine_limits_of_power(const ParsedExpression& base,
                                                       const ParsedExpression& exponent,
                                                       const GiNaC::numeric& value);

}  // namespace regulus::detail
