// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/manual/page.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace regulus::detail::test {
namespace {

constexpr double kAgreement = 1e-3;

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// A number and the text around it, as in "[-1.5," or "2.3e-5)".
struct Number {
  std::string before, after;
  double value = 0;
};

bool read_number(const std::string& word, Number& number) {
  const std::size_t begin = word.find_first_of("-0123456789");
  if (begin == std::string::npos) return false;
  const char* last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data() + begin, last, number.value);
  number.before = word.substr(0, begin);
  number.after = std::string(end, last);
  return error == std::errc();
}

/// Returns true for abridged words: "…" matches any word, "0.21…," one with this start and end.
bool is_abridged(const std::string& shown, const std::string& printed) {
  static const std::string kEllipsis = "…";
  const std::size_t at = shown.find(kEllipsis);
  if (at == std::string::npos) return false;
  const std::string before = shown.substr(0, at), after = shown.substr(at + kEllipsis.size());
  return printed.size() >= before.size() + after.size() && printed.starts_with(before) &&
         printed.ends_with(after);
}

/// Returns true for instruction sets: pages show those of one processor.
bool is_isa(const std::string& word) {
  return word == "avx512," || word == "avx2," || word == "portable,";
}

bool word_agrees(const std::string& shown, const std::string& printed) {
  if (shown == printed || is_abridged(shown, printed)) return true;
  if (is_isa(shown) && is_isa(printed)) return true;
  Number a, b;
  return read_number(shown, a) && read_number(printed, b) && a.before == b.before &&
         a.after == b.after &&
         std::fabs(a.value - b.value) <=
             kAgreement * std::fmax(std::fabs(a.value), std::fabs(b.value));
}

bool line_agrees(const std::string& shown, const std::string& printed) {
  if (shown == printed) return true;
  const auto a = words_of(shown), b = words_of(printed);
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  if (a[0] == b[0] && a[0] == "time") return true;
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!word_agrees(a[i], b[i])) return false;
  return true;
}

bool agrees_from(const std::vector<std::string>& shown, std::size_t i,
                 const std::vector<std::string>& printed, std::size_t j) {
  for (; i < shown.size(); ++i, ++j) {
    if (shown[i] == "...") {
      for (; j <= printed.size(); ++j)
        if (agrees_from(shown, i + 1, printed, j)) return true;
      return false;
    }
    if (j == printed.size() || !line_agrees(shown[i], printed[j])) return false;
  }
  return j == printed.size();
}

}  // namespace

Page read_page(const std::string& path) {
  Page page;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) page.lines.push_back(line);
  return page;
}

void write_page(const std::string& path, const Page& page) {
  std::ofstream file(path);
  for (const std::string& line : page.lines) file << line << '\n';
}

std::vector<Block> Page::blocks() const {
  std::vector<Block> result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].starts_with("```")) continue;
    Block block;
    const auto words = words_of(lines[i].substr(3));
    if (!words.empty()) block.language = words[0];
    if (words.size() > 1) {
      const std::size_t equals = words[1].find('=');
      block.attribute = words[1].substr(0, equals);
      if (equals != std::string::npos) block.value = words[1].substr(equals + 1);
    }
    block.first_line = ++i;
    for (; i < lines.size() && lines[i] != "```"; ++i) block.lines.push_back(lines[i]);
    result.push_back(std::move(block));
  }
  return result;
}

std::vector<Step> steps_of(const Block& block) {
  std::vector<Step> steps;
  for (std::size_t i = 0; i < block.lines.size(); ++i) {
    const std::string& line = block.lines[i];
    if (line.starts_with("$ ")) {
      steps.push_back({line.substr(2), {}, 0});
      while (steps.back().command.ends_with("\\") && i + 1 < block.lines.size())
        steps.back().command += '\n' + block.lines[++i];
      steps.back().first_line = block.first_line + i + 1;
    } else if (!steps.empty()) {
      steps.back().output.push_back(line);
    }
  }
  return steps;
}

bool agrees(const std::vector<std::string>& shown, const std::vector<std::string>& printed) {
  return agrees_from(shown, 0, printed, 0);
}

}  // namespace regulus::detail::test
