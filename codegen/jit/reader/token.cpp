// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/reader/token.hpp"

#include <algorithm>

namespace regulus::codegen::reader {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::size_t name_length(std::string_view text) {
  const auto end = std::find_if_not(text.begin(), text.end(),
                                    [](char c) { return is_letter(c) || is_digit(c); });
  return static_cast<std::size_t>(end - text.begin());
}

/// A preprocessing number, [lex.ppnumber]: a sign belongs to it after an exponent's letter.
std::size_t number_length(std::string_view text) {
  std::size_t length = 0;
  while (length < text.size()) {
    const char c = text[length];
    const bool exponent =
        length > 0 && std::string_view("eEpP").find(text[length - 1]) != std::string_view::npos;
    if (!is_digit(c) && !is_letter(c) && c != '.' && !(exponent && (c == '+' || c == '-'))) break;
    ++length;
  }
  return length;
}

/// The marks of two characters that kernels use, and those that must not be taken for two marks.
std::size_t mark_length(std::string_view text) {
  for (const char* mark : {"|=", "<=", "++", "--", "+=", "-=", "*=", "==", "->"})
    if (text.starts_with(mark)) return 2;
  if (std::string_view("+-*(){}[]<>=,;:&#").find(text.front()) == std::string_view::npos)
    throw OutsideSubset("a character that no kernel has");
  return 1;
}

}  // namespace

void Lexer::skip_space() {
  constexpr std::string_view kSpace = " \t\r\n";
  for (;;) {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpace), rest_.size()));
    if (!rest_.starts_with("//")) return;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    // A backslash there would join the next line to the comment.
    if (rest_.substr(0, end).find('\\') != std::string_view::npos)
      throw OutsideSubset("a comment with a backslash");
    rest_.remove_prefix(end);
  }
}

Token Lexer::take(TokenKind kind, std::size_t length) {
  const Token token{kind, rest_.substr(0, length)};
  rest_.remove_prefix(length);
  return token;
}

Token Lexer::next() {
  skip_space();
  if (rest_.empty()) return {};
  const char c = rest_.front();
  if (is_letter(c)) return take(TokenKind::kName, name_length(rest_));
  if (is_digit(c)) return take(TokenKind::kNumber, number_length(rest_));
  if (c != '"') return take(TokenKind::kMark, mark_length(rest_));
  const std::size_t end = rest_.find_first_of("\"\\\n", 1);
  if (end == std::string_view::npos || rest_[end] != '"')
    throw OutsideSubset("a string that is not plain");
  const Token token = take(TokenKind::kString, end + 1);
  return {TokenKind::kString, token.text.substr(1, end - 1)};
}

}  // namespace regulus::codegen::reader
