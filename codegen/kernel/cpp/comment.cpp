// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/comment.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace regulus::detail {
namespace {

constexpr std::size_t kColumns = 100;

struct Character {
  std::size_t length = 0;  ///< bytes; 0 if the bytes are not UTF-8
  std::uint32_t code = 0;
};

/// The UTF-8 character at the front of the text; shortest forms only.
Character decode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {1, byte(0)};
  const std::size_t length = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < length) return {};
  std::uint32_t code = byte(0) & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = (code << 6) | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kFirst = {0, 0, 0x80, 0x800, 0x10000};
  if (code < kFirst[length]) return {};
  return {length, code};
}

/// True for letters and mathematical signs that are displayed as they are. False for all scripts
/// and controls that reorder, join or hide characters.
bool is_plain(std::uint32_t code) {
  struct Range {
    std::uint32_t first;
    std::uint32_t last;
  };
  constexpr std::array<Range, 8> kPlain = {{{0x20, 0x7E},
                                            {0xA1, 0xAC},
                                            {0xAE, 0x24F},
                                            {0x391, 0x3C9},
                                            {0x2013, 0x2014},
                                            {0x2026, 0x2026},
                                            {0x2070, 0x209C},
                                            {0x2190, 0x22FF}}};
  return code != '\\' && std::any_of(kPlain.begin(), kPlain.end(), [&](const Range& range) {
           return range.first <= code && code <= range.last;
         });
}

/// Marks that some compilers interpret inside comments: "/*" warns, "*/" ends, "??/" was a
/// backslash.
bool is_mark(char before, char c) {
  return (before == '/' && c == '*') || (before == '*' && c == '/') || (before == '?' && c == '?');
}

std::size_t columns(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

/// Writes words after `first`, and on further lines after `next`.
std::string wrap(const std::string& first, const std::string& next, std::string_view text) {
  std::string lines;
  std::string line = first;
  bool empty = true;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!empty && columns(line) + 1 + columns(word) > kColumns) {
      lines += line + "\n";
      line = next;
      empty = true;
    }
    line.append(empty ? "" : " ").append(word);
    empty = false;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return lines + line + "\n";
}

}  // namespace

std::string comment_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Character character = decode(text);
    const std::size_t length = std::max<std::size_t>(character.length, 1);
    if (character.length == 0 || !is_plain(character.code))
      result += '?';
    else if (!result.empty() && is_mark(result.back(), text.front()))
      result.append(" ").append(text.substr(0, length));
    else
      result += text.substr(0, length);
    text.remove_prefix(length);
  }
  return result;
}

std::string comment_lines(std::string_view indent, std::string_view text) {
  const std::string start = std::string(indent) + "// ";
  return wrap(start, start, comment_text(text));
}

std::string labelled_comment(std::string_view label, std::string_view text) {
  constexpr std::size_t kTextColumn = 20;
  std::string start = "// " + std::string(label);
  start.resize(std::max(start.size() + 1, kTextColumn), ' ');
  return wrap(start, "//" + std::string(start.size() - 2, ' '), comment_text(text));
}

}  // namespace regulus::detail
