// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/changes.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

namespace regulus::attack {
namespace {

using Lines = std::vector<std::string>;

constexpr std::size_t kNowhere = std::string::npos;

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string joined(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

bool is_digit(char c) { return '0' <= c && c <= '9'; }
bool is_word(char c) {
  return is_digit(c) || ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_';
}

struct Token {
  std::size_t begin = kNowhere, end = kNowhere;
};

/// Returns the numbers (or the names) of a line, from `from` on. A digit in a name is no number.
std::vector<Token> tokens(const std::string& line, std::size_t from, bool numbers) {
  std::vector<Token> found;
  for (std::size_t i = from; i < line.size();) {
    if (!is_word(line[i])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < line.size() && (is_word(line[end]) || (is_digit(line[i]) && line[end] == '.')))
      ++end;
    if (is_digit(line[i]) == numbers) found.push_back({i, end});
    i = end;
  }
  return found;
}

std::string other_number(const std::string& number, Random& random) {
  switch (random.below(6)) {
    case 0:
      return "0";
    case 1:
      return "(" + number + "+1)";
    case 2:
      return number + (number.find('.') == kNowhere ? ".000000001" : "000000001");
    case 3:
      return "(" + number + "*1.0000000000000000000000001)";
    case 4:
      return "(-" + number + ")";
    default: {
      std::string digits = number;
      const std::size_t at = random.below(digits.size());
      if (is_digit(digits[at])) digits[at] = char('0' + (digits[at] - '0' + 1) % 10);
      return digits;
    }
  }
}

/// Polynomials that are 0 at short numbers, and terms that are 0 nearly everywhere.
std::string hidden_term(const std::string& name, Random& random) {
  const std::string x = "(" + name + ")";
  switch (random.below(4)) {
    case 0:
      return " + " + x + "*(" + x + "-1)*(" + x + "+1)*(2*" + x + "-1)";
    case 1:
      return " + 0.000000000000000000000000000000000001*" + x;
    case 2:
      return " + sqrt(" + x + "^2) - " + x;
    default:
      return " + " + x + "/" + x + " - 1";
  }
}

bool change_number(std::string& line, std::size_t from, Random& random) {
  const std::vector<Token> found = tokens(line, from, true);
  if (found.empty()) return false;
  const Token token = random.pick(found);
  const std::string number = line.substr(token.begin, token.end - token.begin);
  line.replace(token.begin, token.end - token.begin, other_number(number, random));
  return true;
}

/// Exchanges a name for another of the file.
bool change_name(std::string& line, std::size_t from, const Lines& lines, Random& random) {
  const std::vector<Token> found = tokens(line, from, false);
  if (found.empty()) return false;
  const std::string& other = lines[random.below(lines.size())];
  const std::vector<Token> names = tokens(other, 0, false);
  if (names.empty()) return false;
  const Token name = random.pick(names), token = random.pick(found);
  line.replace(token.begin, token.end - token.begin,
               other.substr(name.begin, name.end - name.begin));
  return true;
}

bool add_term(std::string& line, std::size_t from, const Lines& lines, Random& random) {
  const std::string& other = lines[random.below(lines.size())];
  const std::vector<Token> names = tokens(other, 0, false);
  if (names.empty() || line.size() <= from) return false;
  const Token name = random.pick(names);
  line += hidden_term(other.substr(name.begin, name.end - name.begin), random);
  return true;
}

std::string described(std::size_t line, const std::string& before, const std::string& after) {
  return "line " + std::to_string(line + 1) + ": '" + before + "' -> '" + after + "'";
}

/// A line that the certificate need not have.
std::string new_line(const Lines& lines, std::size_t end, Random& random) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < end; ++i)
    for (const char* kind : {"parameter ", "uncertain ", "pose "})
      if (lines[i].starts_with(kind)) {
        const std::string rest = lines[i].substr(std::string(kind).size());
        names.push_back(rest.substr(0, rest.find(' ')));
      }
  const std::string name = names.empty() ? "x" : random.pick(names);
  switch (random.below(9)) {
    case 0:
      return "constraint " + name + " - 1/1000";
    case 5:
      return "pose t = " + name;
    case 6:
      return "parameter rho_1 in 0 : 1";
    case 7:
      return "uncertain z_z = 0 +- 1/1000";
    case 1:
      return "ball " + name + (names.size() < 2 ? "" : " " + random.pick(names));
    case 2:
      return "scale 2";
    case 3:
      return "reach " + name;
    case 4:
      return "constant z_z = 1";
    default:
      return "let z_z = " + name;
  }
}

/// Returns where the text of a line begins that has a meaning: after its keyword, or its name.
std::size_t meaning_of(const std::string& line) {
  const std::size_t word = line.find(' ');
  return word == kNowhere ? line.size() : word + 1;
}

}  // namespace

Change change_certificate(const std::string& certificate, Random& random) {
  Lines lines = lines_of(certificate);
  const auto proof = std::find(lines.begin(), lines.end(), "proof");
  const std::size_t end = std::size_t(proof - lines.begin());
  const Lines head(lines.begin(), proof);
  for (;;) {
    // The first lines are the format, the verdict, the claim and the labels of the model.
    const std::size_t at = 5 + random.below(end - 5);
    const std::string before = lines[at];
    const std::size_t from = meaning_of(before);
    bool changed = false;
    switch (random.below(8)) {
      case 0:
        lines.erase(lines.begin() + std::ptrdiff_t(at));
        return {joined(lines), described(at, before, "")};
      case 1: {
        const std::string added = new_line(lines, end, random);
        lines.insert(lines.begin() + std::ptrdiff_t(at), added);
        return {joined(lines), described(at, "", added)};
      }
      case 2: {
        const std::size_t other = 5 + random.below(end - 5);
        if (lines[other].substr(0, meaning_of(lines[other])) != before.substr(0, from)) break;
        std::swap(lines[at], lines[other]);
        changed = lines[at] != before;
        break;
      }
      case 3:
        changed = change_name(lines[at], from, head, random);
        break;
      case 4:
        changed = add_term(lines[at], from, head, random);
        break;
      default:
        changed = change_number(lines[at], from, random);
    }
    if (changed && lines[at] != before) return {joined(lines), described(at, before, lines[at])};
    lines[at] = before;
  }
}

Change change_model(const std::string& model, Random& random) {
  Lines lines = lines_of(model);
  for (;;) {
    const std::size_t at = random.below(lines.size());
    const std::string before = lines[at];
    if (before.empty() || before.front() == '#' || before.starts_with("regulus =")) continue;
    const std::size_t comment = before.find(" #");
    std::string line = before.substr(0, comment);
    bool changed = false;
    switch (random.below(7)) {
      case 0:
        if (before.front() == '[') continue;
        lines.erase(lines.begin() + std::ptrdiff_t(at));
        return {joined(lines), described(at, before, "")};
      case 1: {
        const std::size_t other = random.below(lines.size());
        const auto key = [](const std::string& text) { return text.substr(0, text.find('=')); };
        if (other == at || key(lines[other]) == lines[other] || key(line) == line) break;
        const std::string value = lines[other].substr(lines[other].find('='));
        line = key(line) + value;
        changed = true;
        break;
      }
      case 2:
        changed = change_name(line, 0, lines, random);
        break;
      default:
        changed = change_number(line, std::min(line.find('='), line.size()), random);
    }
    if (!changed || line == before.substr(0, comment)) continue;
    lines[at] = line;
    return {joined(lines), described(at, before, line)};
  }
}

}  // namespace regulus::attack
