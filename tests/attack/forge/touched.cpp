// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/touched.hpp"

#include <algorithm>
#include <vector>

#include "tests/attack/forge/lines.hpp"

namespace regulus::detail::attack {
namespace {

/// Returns what stands between backticks.
std::vector<std::string> quoted_in(const std::string& text) {
  std::vector<std::string> quoted;
  for (std::size_t at = 0; (at = text.find('`', at)) != std::string::npos; ++at) {
    const std::size_t end = text.find('`', at + 1);
    quoted.push_back(text.substr(at + 1, end - at - 1));
    at = end;
    if (end == std::string::npos) break;
  }
  return quoted;
}

std::string first_word(const std::string& text) { return text.substr(0, text.find(' ')); }

}  // namespace

std::set<std::string> words_of_question(const std::string& certificate) {
  std::set<std::string> words;
  for (const std::string& line : lines_of(certificate)) {
    if (line == "proof") break;
    words.insert(first_word(line));
  }
  return words;
}

std::string verdict_of(const std::string& certificate) {
  for (const std::string& line : lines_of(certificate))
    if (line.starts_with("verdict ")) return line.substr(8);
  return "";
}

std::set<std::string> verdicts_of_format(const std::string& page) {
  for (const std::string& line : lines_of(page)) {
    if (!line.starts_with("| `verdict V` | ")) continue;
    std::vector<std::string> quoted = quoted_in(line);
    return {quoted.begin() + 1, quoted.end()};
  }
  return {};
}

std::set<std::string> words_touched(const std::string& before, const std::string& after) {
  const std::vector<std::string> was = lines_of(before), is = lines_of(after);
  std::multiset<std::string> only(was.begin(), was.end()), added;
  for (const std::string& line : is)
    if (const auto same = only.find(line); same != only.end())
      only.erase(same);
    else
      added.insert(line);
  only.merge(added);
  std::set<std::string> words;
  for (const std::string& line : only) {
    const std::string word = first_word(line);
    words.insert(word);
    if (word == "quantity" && word != line) words.insert(line.substr(word.size() + 1));
  }
  return words;
}

std::set<std::string> words_of_format(const std::string& page) {
  std::set<std::string> words;
  for (const std::string& line : lines_of(page)) {
    if (!line.starts_with("| `")) continue;
    for (const std::string& quoted : quoted_in(line.substr(0, line.find(" | "))))
      words.insert(first_word(quoted));
  }
  return words;
}

}  // namespace regulus::detail::attack
