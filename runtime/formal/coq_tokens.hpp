// SPDX-License-Identifier: Apache-2.0
// The words of a theorem file, read so that Coq can only read the same ones.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regulus::verifier {

struct CoqToken {
  enum class Kind { kWord, kNumber, kSymbol, kPeriod };
  Kind kind = Kind::kSymbol;
  std::string_view text;
  std::size_t line = 0;  ///< from 1
};

/// True for a character that a comment may have: printable, and shown where it stands. Characters
/// that hide text, or change its direction, are not.
[[nodiscard]] bool is_plain_character(char32_t c) noexcept;

/// Takes a character of UTF-8 off the text; 0 for bytes that are none, and then takes one byte.
char32_t take_character(std::string_view& text) noexcept;

/// Returns the tokens of a text, which must outlive them. Throws Rejection, with the line, for what
/// is not plain: characters outside ASCII but in comments, quotation marks, a period that is not the
/// end of a sentence or in a number, a number beside a word.
[[nodiscard]] std::vector<CoqToken> coq_tokens(std::string_view text);

/// Returns the tokens, separated by spaces.
[[nodiscard]] std::string joined(const std::vector<CoqToken>& tokens);

}  // namespace regulus::verifier
