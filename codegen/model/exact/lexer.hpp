// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts an expression into tokens. The degree sign is a name; each other character that is not arithmetic is a token of its own; the
// parser refuses it.
#pragma once

#include <cstddef>
#include <string_view>

namespace regulus::detail {

struct Token {
  enum class Kind { kEnd, kNumber, kName, kSymbol };
  Kind kind = Kind::kEnd;
  std::string_view text;   ///< for kSymbol one character
  std::size_t column = 1;  ///< of its first byte in the expression, from 1

  [[nodiscard]] bool is(char symbol) const noexcept {
    return kind == Kind::kSymbol && text.front() == symbol;
  }
};

class Lexer {
 public:
  /// The text must outlive the lexer and its tokens.
  explicit Lexer(std::string_view text) noexcept : text_(text) {}

  /// Returns the next token; at the end, always kEnd.
  [[nodiscard]] Token next() noexcept;

 private:
  [[nodiscard]] std::size_t number_end(std::size_t begin) const noexcept;
  [[nodiscard]] std::size_t skip_digits(std::size_t begin) const noexcept;
  [[nodiscard]] Token token(Token::Kind kind, std::size_t end) noexcept;

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace regulus::detail
