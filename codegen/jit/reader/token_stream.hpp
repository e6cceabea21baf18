// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

#include "regulus/codegen/jit/reader/token.hpp"

namespace regulus::codegen::reader {

/// One token of look-ahead, and what is asked of it.
class TokenStream {
 public:
  explicit TokenStream(std::string_view text) : lexer_(text), token_(lexer_.next()) {}

  [[nodiscard]] const Token& peek() const noexcept { return token_; }
  [[nodiscard]] bool at_end() const noexcept { return token_.kind == TokenKind::kEnd; }
  [[nodiscard]] bool at(std::string_view text) const noexcept {
    return token_.kind != TokenKind::kString && token_.kind != TokenKind::kEnd &&
           token_.text == text;
  }
  Token take();
  bool accept(std::string_view text);
  void expect(std::string_view text);

  /// A name that is no keyword of the subset.
  std::string_view name();
  std::int64_t integer();  ///< with or without a sign

 private:
  Lexer lexer_;
  Token token_;
};

/// Whether a number is a floating literal, and the double it is, correctly rounded.
[[nodiscard]] bool is_floating(std::string_view number);
[[nodiscard]] double floating(std::string_view number);

}  // namespace regulus::codegen::reader
