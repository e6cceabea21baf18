// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/lexer.hpp"

namespace regulus::detail {
namespace {

// <cctype> depends on the locale.
bool is_decimal_digit(char c) noexcept { return '0' <= c && c <= '9'; }
bool is_letter(char c) noexcept { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); }
bool is_space(char c) noexcept { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

constexpr std::string_view kDegreeSign = "°";

}  // namespace

Token Lexer::next() noexcept {
  while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  if (at_ == text_.size()) return token(Token::Kind::kEnd, at_);
  const std::size_t end_of_number = number_end(at_);
  if (end_of_number > at_) return token(Token::Kind::kNumber, end_of_number);
  if (text_.substr(at_).starts_with(kDegreeSign))
    return token(Token::Kind::kName, at_ + kDegreeSign.size());
  if (!is_letter(text_[at_])) return token(Token::Kind::kSymbol, at_ + 1);
  std::size_t end = at_ + 1;
  while (end < text_.size() &&
         (is_letter(text_[end]) || is_decimal_digit(text_[end]) || text_[end] == '_'))
    ++end;
  return token(Token::Kind::kName, end);
}

std::size_t Lexer::skip_digits(std::size_t at) const noexcept {
  while (at < text_.size() && is_decimal_digit(text_[at])) ++at;
  return at;
}

/// Returns the end of the longest number that starts at `begin`; `begin` itself if there is none.
std::size_t Lexer::number_end(std::size_t begin) const noexcept {
  std::size_t end = skip_digits(begin);
  bool any_digit = end > begin;
  if (end < text_.size() && text_[end] == '.') {
    const std::size_t fraction = end + 1;
    end = skip_digits(fraction);
    any_digit = any_digit || end > fraction;
  }
  if (!any_digit) return begin;
  if (end == text_.size() || (text_[end] != 'e' && text_[end] != 'E')) return end;
  std::size_t digits = end + 1;
  if (digits < text_.size() && (text_[digits] == '+' || text_[digits] == '-')) ++digits;
  const std::size_t exponent_end = skip_digits(digits);
  return exponent_end > digits ? exponent_end : end;
}

Token Lexer::token(Token::Kind kind, std::size_t end) noexcept {
  const Token result{kind, text_.substr(at_, end - at_), at_ + 1};
  at_ = end;
  return result;
}

}  // namespace regulus::detail
