// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace regulus {

/// How strongly the outermost operation of a text holds its operands together.
enum class Precedence { kSum, kProduct, kSign, kPower, kPrimary };

[[nodiscard]] inline std::string in_parentheses(std::string_view text) {
  return std::string("(").append(text).append(")");
}

/// An expression as text, for writers that add only the parentheses that are needed.
struct InfixText {
  std::string text;
  Precedence precedence = Precedence::kPrimary;

  /// Returns the text, in parentheses if its outermost operation is weaker than `least`.
  [[nodiscard]] std::string at_least(Precedence least) const {
    return precedence < least ? in_parentheses(text) : text;
  }
};

}  // namespace regulus
