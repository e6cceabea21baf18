// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "codegen/symbolic/expression.hpp"

namespace regulus::inline symbolic {

/// Gives a value to a sub-expression, or leaves it to be computed from its operands.
using ValueOf = std::function<std::optional<cln::cl_RA>(const Expression&)>;

/// The exact value of an expression.
///
/// Requires  `known` answers for every symbol, for pi, and for every call whose value is not a
///           rational that follows from its arguments: all but abs and roots of rational squares.
/// Ensures   the result is exact; throws std::domain_error where the expression is undefined or
///           a value is missing.
[[nodiscard]] cln::cl_RA evaluate(const Expression& expression, const ValueOf& known);

/// The expression with sub-expressions replaced, each distinct one asked for once.
using ReplacementOf = std::function<std::optional<Expression>(const Expression&)>;
[[nodiscard]] Expression substitute(const Expression& expression, const ReplacementOf& replacement);
[[nodiscard]] Expressions substitute(const Expressions& expressions,
                                     const ReplacementOf& replacement);

}  // namespace regulus::inline symbolic
