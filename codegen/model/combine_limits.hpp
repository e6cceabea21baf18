// SPDX-License-Identifier: GPL-3.0-or-later
// Accounts for what an operation adds to a written expression, before it is carried out.
#pragma once

#include <vector>

#include "codegen/model/parsed_expression.hpp"

namespace regulus::inline model {

// Each returns a ParsedExpression that has everything of its operands but the value, and throws
// Refusal when it would exceed a limit of parsed_expression.hpp. Coefficients of a sum or product
// have at most the bits of all operands together, those of a power |exponent| times as many.

[[nodiscard]] ParsedExpression combine_limits(const std::vector<Operand>& operands);
[[nodiscard]] ParsedExpression combine_limits(const std::vector<ParsedExpression>& operands);
/// value: the exponent's.
[[nodiscard]] ParsedExpression combine_limits_of_power(const ParsedExpression& base,
                                                       const ParsedExpression& exponent,
                                                       const GiNaC::numeric& value);

}  // namespace regulus::inline model
