// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/names.hpp"

#include <algorithm>

namespace regulus::detail {
namespace {

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

}  // namespace

std::string identifier_part(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const char next = is_letter_or_digit(c) ? c : '_';
    // Names with two consecutive underscores are reserved for the compiler.
    if (next != '_' || result.empty() || result.back() != '_') result += next;
  }
  while (!result.empty() && result.back() == '_') result.pop_back();
  return result.empty() || result.front() == '_' ? "x" + result : result;
}

bool is_identifier(std::string_view text) {
  if (text.empty() || (text.front() >= '0' && text.front() <= '9')) return false;
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return is_letter_or_digit(c) || c == '_'; });
}

std::string NameTable::take(const std::string& wanted) {
  std::string name = wanted;
  for (int number = 2; !taken_.insert(name).second; ++number)
    name = wanted + "_" + std::to_string(number);
  return name;
}

}  // namespace regulus::detail
