// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace regulus::codegen::reader {

/// The text is not of the form that emitted kernels have: it is left to a C++ compiler.
class OutsideSubset : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class TokenKind { kName, kNumber, kString, kMark, kEnd };

struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string_view text;  ///< of a string: what is between the quotes
};

/// The tokens of a C++ text, one after the other. Comments and space are skipped.
///
/// Throws    OutsideSubset where a token is none of the few kinds that kernels use.
class Lexer {
 public:
  explicit Lexer(std::string_view text) : rest_(text) {}
  [[nodiscard]] Token next();

 private:
  void skip_space();
  Token take(TokenKind kind, std::size_t length);

  std::string_view rest_;
};

}  // namespace regulus::codegen::reader
