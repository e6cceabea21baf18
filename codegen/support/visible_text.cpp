// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/visible_text.hpp"

#include <bit>

namespace regulus::detail {
namespace {

/// Returns the number of bytes of the character in UTF-8 at the start; 0: it has none.
std::size_t length_at(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto ones = static_cast<std::size_t>(std::countl_one(byte(0)));
  if (ones == 0) return 1;
  if (ones == 1 || ones > 4 || ones > text.size()) return 0;
  for (std::size_t i = 1; i < ones; ++i)
    if (std::countl_one(byte(i)) != 1) return 0;
  return ones;
}

/// Requires  the text is one character.
char32_t code_of(std::string_view text) {
  if (text.size() == 1) return static_cast<unsigned char>(text[0]);
  char32_t code = static_cast<unsigned char>(text[0]) & (0x7fU >> text.size());
  for (const char c : text.substr(1)) code = code << 6U | (static_cast<unsigned char>(c) & 0x3fU);
  return code;
}

/// C0, DEL and C1, the separators of lines and paragraphs, and the bidirectional controls of
/// Unicode Standard Annex #9.
bool is_control(char32_t c) {
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x61c || c == 0x200e || c == 0x200f ||
         (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
}

/// The shortest form of a code that a character may have; otherwise it could hide another one.
bool is_shortest(char32_t code, std::size_t length) {
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  return code >= kLeast[length] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
}

void append_bytes(std::string& to, std::string_view bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    to += {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 15U]};
  }
}

}  // namespace

std::string visible(std::string_view text, bool lines) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = length_at(text);
    const std::string_view character = text.substr(0, length == 0 ? 1 : length);
    const char32_t code = length == 0 ? 0 : code_of(character);
    const bool is_kept = length > 0 && is_shortest(code, length) && !is_control(code);
    if (is_kept || (lines && code == U'\n'))
      result += character;
    else
      append_bytes(result, character);
    text.remove_prefix(character.size());
  }
  return result;
}

}  // namespace regulus::detail
