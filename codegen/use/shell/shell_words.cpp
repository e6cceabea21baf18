// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/shell/shell_words.hpp"

#include "codegen/model/request.hpp"

namespace regulus::detail {

std::vector<std::string> split_words(std::string_view line) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = 0;
  for (const char c : line) {
    if (quote == 0 && !in_word && c == '#') break;
    const bool blank = quote == 0 && (c == ' ' || c == '\t' || c == '\r');
    if (!blank && !in_word) words.emplace_back();
    in_word = !blank;
    if (quote == 0 && (c == '"' || c == '\''))
      quote = c;
    else if (c == quote)
      quote = 0;
    else if (!blank)
      words.back() += c;
  }
  if (quote != 0) throw UsageError("a quote is not closed; add another " + std::string(1, quote));
  return words;
}

std::string rest_of(const std::vector<std::string>& words, std::size_t from) {
  std::string text;
  for (std::size_t i = from; i < words.size(); ++i) text += (i == from ? "" : " ") + words[i];
  return text;
}

}  // namespace regulus::detail
