// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <unordered_map>
#include <utility>

#include "codegen/kernel/symbolic/expression.hpp"

namespace regulus::detail {

/// Gives a value to a sub-expression, or leaves it to be computed from its operands.
using ValueOf = std::function<std::optional<cln::cl_RA>(const Expression&)>;

/// Returns the exact value of an expression.
///
/// Requires  `known` has a value for every symbol, for pi, and for every call except abs and roots
///           of rational squares, whose rational values follow from their arguments.
/// Ensures   the result is exact; throws std::domain_error if the expression is undefined or a
///           value is missing.
[[nodiscard]] cln::cl_RA evaluate(const Expression& expression, const ValueOf& known);

/// Returns the replacement of a sub-expression, if any. Called once for each distinct one.
using ReplacementOf = std::function<std::optional<Expression>(const Expression&)>;

/// Makes the same replacement in many expressions: parts that they share are replaced once.
class Replacer {
 public:
  explicit Replacer(ReplacementOf replacement) : replacement_(std::move(replacement)) {}

  /// The result is valid as long as this object.
  [[nodiscard]] const Expression& apply(const Expression& e);

 private:
  [[nodiscard]] Expression rebuilt(const Expression& e);

  struct Known {
    Expression source;  ///< kept, so that its identity is not given to another expression
    Expression result;
  };
  ReplacementOf replacement_;
  std::unordered_map<const void*, Known> known_;
};

[[nodiscard]] Expression substitute(const Expression& expression, const ReplacementOf& replacement);
[[nodiscard]] Expressions substitute(const Expressions& expressions,
                                     const ReplacementOf& replacement);

}  // namespace regulus::detail
