// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/touched.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

namespace regulus::attack {
namespace {

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

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
  for (const std::string& line : split_lines(certificate)) {
    if (line == "proof") break;
    words.insert(first_word(line));
  }
  return words;
}

std::string verdict_of(const std::string& certificate) {
  for (const std::string& line : split_lines(certificate))
    if (line.starts_with("verdict ")) return line.substr(8);
  return "";
}

std::set<std::string> verdicts_of_format(const std::string& page) {
  for (const std::string& line : split_lines(page)) {
    if (!line.starts_with("| `verdict V` | ")) continue;
    std::vector<std::string> quoted = quoted_in(line);
    return {quoted.begin() + 1, quoted.end()};
  }
  return {};
}

std::set<std::string> words_touched(const std::string& before, const std::string& after) {
  const std::vector<std::string> was = split_lines(before), is = split_lines(after);
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
  for (const std::string& line : split_lines(page)) {
    if (!line.starts_with("| `")) continue;
    for (const std::string& quoted : quoted_in(line.substr(0, line.find(" | "))))
      words.insert(first_word(quoted));
  }
  return words;
}

}  // namespace regulus::attack
