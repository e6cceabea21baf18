// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/changes.hpp"
#include "tests/attack/forge/lines.hpp"
#include "tests/attack/forge/words.hpp"

namespace regulus::detail::attack {
namespace {

/// Changes a digit, a sign or the size of a number between letters, as those of G-code are.
void change_digits(std::string& line, Random& random) {
  std::vector<std::size_t> digits;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (is_digit(line[i])) digits.push_back(i);
  if (digits.empty()) return;
  const std::size_t at = random.pick(digits);
  std::size_t begin = at;
  while (begin > 0 && (is_digit(line[begin - 1]) || line[begin - 1] == '.')) --begin;
  const bool is_negative = begin > 0 && line[begin - 1] == '-';
  switch (random.below(4)) {
    case 0:
      return void(line.insert(at + 1, "0"));
    case 1:
      return void(is_negative ? line.erase(begin - 1, 1) : line.insert(begin, "-"));
    default:
      line[at] = char('0' + (line[at] - '0' + 1 + int(random.below(9))) % 10);
  }
}

}  // namespace

Change change_waypoints(const std::string& waypoints, Random& random) {
  Lines lines = lines_of(waypoints);
  for (;;) {
    const std::size_t at = random.below(lines.size()), other = random.below(lines.size());
    const std::string before = lines[at];
    switch (random.below(6)) {
      case 0:
        lines.erase(lines.begin() + std::ptrdiff_t(at));
        return {joined(lines), described(at, before, "")};
      case 1:
        lines.insert(lines.begin() + std::ptrdiff_t(at), lines[other]);
        return {joined(lines), described(at, "", lines[at])};
      case 2:
        std::swap(lines[at], lines[other]);
        break;
      default:
        change_digits(lines[at], random);
    }
    if (lines[at] != before) return {joined(lines), described(at, before, lines[at])};
  }
}

}  // namespace regulus::detail::attack
