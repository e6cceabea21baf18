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

}  // namespace

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
    const std::string word = line.substr(0, line.find(' '));
    words.insert(word);
    if (word == "quantity" && word != line) words.insert(line.substr(word.size() + 1));
  }
  return words;
}

std::set<std::string> words_of_format(const std::string& page) {
  std::set<std::string> words;
  for (const std::string& line : split_lines(page)) {
    if (!line.starts_with("| `")) continue;
    const std::string cell = line.substr(0, line.find(" | "));
    for (std::size_t at = 0; (at = cell.find('`', at)) != std::string::npos; ++at) {
      const std::size_t end = cell.find('`', at + 1);
      words.insert(cell.substr(at + 1, std::min(end, cell.find(' ', at)) - at - 1));
      at = end;
    }
  }
  return words;
}

}  // namespace regulus::attack
