// SPDX-License-Identifier: Apache-2.0
// Lines of certificates, and lists of Coq.
#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/formal/coq_question.hpp"

namespace regulus::verifier {

std::string_view take_until(std::string_view& text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + mark.size());
  return taken;
}

std::string coq_list(const std::vector<CoqItem>& items, const std::string& margin) {
  std::string text = "[";
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += ";\n" + margin;
    if (!items[i].comment.empty()) text += "(* " + items[i].comment + " *) ";
    text += items[i].text;
  }
  return text + "]";
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::string_view rest = text;
  while (!rest.empty()) lines.emplace_back(take_until(rest, "\n"));
  return lines;
}

std::set<std::string, std::less<>> names_used(const std::vector<std::string>& lines,
                                              bool with_scales) {
  static constexpr std::string_view
      kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ",
      kCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  std::set<std::string, std::less<>> used;
  const auto add = [&used](std::string_view text) {
    while (!text.empty()) {
      text.remove_prefix(std::min(text.find_first_of(kLetters), text.size()));
      const std::string_view name = text.substr(0, text.find_first_not_of(kCharacters));
      if (!name.empty()) used.emplace(name);
      text.remove_prefix(name.size());
    }
  };
  for (const std::string_view line : lines)
    if (line.starts_with("entry ") || (with_scales && line.starts_with("scale ")))
      add(line.substr(6));
  for (auto at = lines.rbegin(); at != lines.rend(); ++at)
    if (std::string_view line = *at;
        take_until(line, " ") == "let" && used.contains(take_until(line, " = ")))
      add(line);
  return used;
}

}  // namespace regulus::verifier
