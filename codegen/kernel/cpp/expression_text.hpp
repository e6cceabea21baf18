// SPDX-License-Identifier: GPL-3.0-or-later
// Builds C++ expressions with only the parentheses that the order of operations needs.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "codegen/support/infix_text.hpp"

namespace regulus::detail {

using ExpressionText = InfixText;

/// Concatenates the pieces.
[[nodiscard]] std::string concatenate(std::initializer_list<std::string_view> pieces);

[[nodiscard]] ExpressionText atom(std::string text);
[[nodiscard]] ExpressionText negation(const ExpressionText& a);
[[nodiscard]] ExpressionText sum(const ExpressionText& a, const ExpressionText& b);
[[nodiscard]] ExpressionText difference(const ExpressionText& a, const ExpressionText& b);
[[nodiscard]] ExpressionText product(const ExpressionText& a, const ExpressionText& b);

}  // namespace regulus::detail
