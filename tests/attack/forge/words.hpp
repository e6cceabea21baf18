// SPDX-License-Identifier: GPL-3.0-or-later
// Tells the characters of words in certificates and model files.
#pragma once

namespace regulus::detail::attack {

[[nodiscard]] constexpr bool is_digit(char c) { return '0' <= c && c <= '9'; }

[[nodiscard]] constexpr bool is_word(char c) {
  return is_digit(c) || ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_';
}

}  // namespace regulus::detail::attack
