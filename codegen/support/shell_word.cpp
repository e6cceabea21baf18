// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/shell_word.hpp"

#include <algorithm>

namespace regulus::detail {
namespace {

bool is_plain(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') ||
         std::string_view("_-./,:=+@%").find(c) != std::string_view::npos;
}

}  // namespace

std::string shell_word(std::string_view word) {
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_command(std::span<const std::string> words) {
  std::string command;
  for (const std::string& word : words) command += (command.empty() ? "" : " ") + shell_word(word);
  return command;
}

std::vector<std::string> words_of_command(std::string_view command) {
  std::vector<std::string> words;
  bool in_word = false, in_quotes = false;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const bool is_blank = !in_quotes && command[i] == ' ';
    if (!is_blank && !in_word) words.emplace_back();
    in_word = !is_blank;
    if (is_blank) continue;
    if (command[i] == '\'')
      in_quotes = !in_quotes;
    else if (!in_quotes && command[i] == '\\' && i + 1 < command.size())
      words.back() += command[++i];
    else
      words.back() += command[i];
  }
  return words;
}

}  // namespace regulus::detail
