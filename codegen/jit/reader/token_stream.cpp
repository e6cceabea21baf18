// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/reader/token_stream.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

namespace regulus::codegen::reader {
namespace {

constexpr std::array<std::string_view, 9> kKeywords = {
    "const", "unsigned", "return", "for", "int", "double", "void", "using", "static_cast"};

bool is_hexadecimal(std::string_view number) {
  return number.starts_with("0x") || number.starts_with("0X");
}

template <class Number, class... Format>
Number parsed(std::string_view number, Format... format) {
  Number value{};
  const char* end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, value, format...);
  if (error != std::errc{} || stop != end)
    throw OutsideSubset("a number that no kernel has: " + std::string(number));
  return value;
}

}  // namespace

Token TokenStream::take() {
  const Token token = token_;
  token_ = lexer_.next();
  return token;
}

bool TokenStream::accept(std::string_view text) {
  if (!at(text)) return false;
  take();
  return true;
}

void TokenStream::expect(std::string_view text) {
  if (!accept(text))
    throw OutsideSubset("found '" + std::string(token_.text) + "', expected '" + std::string(text) +
                        "'");
}

std::string_view TokenStream::name() {
  const bool keyword =
      std::find(kKeywords.begin(), kKeywords.end(), token_.text) != kKeywords.end();
  if (token_.kind != TokenKind::kName || keyword)
    throw OutsideSubset("found '" + std::string(token_.text) + "', expected a name");
  return take().text;
}

std::int64_t TokenStream::integer() {
  const bool negative = accept("-");
  const std::string_view digits = take().text;
  // A leading zero would make it octal.
  if (digits.size() > 1 && digits.starts_with('0')) throw OutsideSubset("an octal number");
  const auto value = parsed<std::int32_t>(digits);
  return negative ? -std::int64_t{value} : value;
}

bool is_floating(std::string_view number) {
  return number.find_first_of(is_hexadecimal(number) ? ".pP" : ".eE") != std::string_view::npos;
}

double floating(std::string_view number) {
  if (is_hexadecimal(number)) return parsed<double>(number.substr(2), std::chars_format::hex);
  return parsed<double>(number, std::chars_format::general);
}

}  // namespace regulus::codegen::reader
