// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/changes.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "tests/attack/forge/lines.hpp"
#include "tests/attack/forge/words.hpp"

namespace regulus::detail::attack {
namespace {

constexpr std::size_t kNowhere = std::string::npos;

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

/// The lines of a certificate up to `proof`.
std::size_t end_of_question(const Lines& lines) {
  return std::size_t(std::find(lines.begin(), lines.end(), "proof") - lines.begin());
}

/// Changes all lines with a number, or with a name, in the same way.
Change change_everywhere(const std::string& certificate, bool numbers, Random& random) {
  Lines lines = lines_of(certificate);
  const std::size_t end = end_of_question(lines);
  for (;;) {
    const std::size_t at = 5 + random.below(end - 5);
    const std::vector<Token> found = tokens(lines[at], meaning_of(lines[at]), numbers);
    if (found.empty()) continue;
    const Token token = random.pick(found);
    const std::string word = lines[at].substr(token.begin, token.end - token.begin);
    std::string other = numbers ? other_number(word, random) : "z_z";
    const bool is_exchange = !numbers && random.one_in(2);
    if (is_exchange) {
      const std::string& from = lines[5 + random.below(end - 5)];
      const std::vector<Token> names = tokens(from, meaning_of(from), false);
      if (names.empty()) continue;
      const Token name = random.pick(names);
      other = from.substr(name.begin, name.end - name.begin);
    }
    if (other == word) continue;
    for (std::size_t i = 5; i < end; ++i) {
      const std::vector<Token> all = tokens(lines[i], meaning_of(lines[i]), numbers);
      for (auto t = all.rbegin(); t != all.rend(); ++t) {
        const std::string was = lines[i].substr(t->begin, t->end - t->begin);
        if (was == word)
          lines[i].replace(t->begin, t->end - t->begin, other);
        else if (is_exchange && was == other)
          lines[i].replace(t->begin, t->end - t->begin, word);
      }
    }
    return {joined(lines), "everywhere: '" + word + "' -> '" + other + "'"};
  }
}

/// Drops, repeats or turns round all lines of a kind.
Change change_kind(const std::string& certificate, Random& random) {
  Lines lines = lines_of(certificate);
  const std::size_t end = end_of_question(lines);
  const std::string& chosen = lines[5 + random.below(end - 5)];
  const std::string kind = chosen.substr(0, meaning_of(chosen));
  Lines of_kind, changed;
  for (std::size_t i = 0; i < end; ++i)
    if (lines[i].starts_with(kind)) of_kind.push_back(lines[i]);
  std::reverse(of_kind.begin(), of_kind.end());
  const std::size_t how = random.below(3);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i >= end || !lines[i].starts_with(kind)) {
      changed.push_back(lines[i]);
    } else if (how == 1) {
      changed.insert(changed.end(), 2, lines[i]);
    } else if (how == 2) {
      changed.push_back(of_kind.front());
      of_kind.erase(of_kind.begin());
    }
  }
  const char* const words[] = {"all dropped: ", "each twice: ", "in reverse: "};
  return {joined(changed), words[how] + kind};
}

/// Changes what a line claims to have a value, or drops it. Nothing if there is no such line.
std::optional<Change> change_condition(const std::string& certificate, Random& random) {
  Lines lines = lines_of(certificate);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < end_of_question(lines); ++i)
    if (lines[i].find("defined ") != kNowhere) places.push_back(i);
  if (places.empty()) return std::nullopt;
  const std::size_t at = random.pick(places);
  const std::string before = lines[at], key = before.substr(0, meaning_of(before)),
                    text = before.substr(meaning_of(before));
  const std::string others[] = {key + "1", key + "0*(" + text + ")", key + "(" + text + ")^2",
                                key + "sqrt((" + text + ")^2)", key + "1/(1 + (" + text + ")^2)"};
  if (random.one_in(3)) {
    lines.erase(lines.begin() + std::ptrdiff_t(at));
    return Change{joined(lines), described(at, before, "")};
  }
  lines[at] = others[random.below(std::size(others))];
  return Change{joined(lines), described(at, before, lines[at])};
}

/// Changes a word of the first lines, or of the proof.
Change change_frame(const std::string& certificate, Random& random) {
  Lines lines = lines_of(certificate);
  const std::size_t end = end_of_question(lines);
  for (;;) {
    const std::size_t rest = lines.size() - end;
    const std::size_t at = random.one_in(2) ? random.below(5) : end + random.below(rest);
    const std::string before = lines[at];
    if (before.starts_with("verdict ")) {
      const char* const verdicts[] = {"NO SINGULARITY", "SINGULARITY", "FEASIBLE", "INFEASIBLE",
                                      "PAVING",         "COMPLETE",    "NONE",     "INCOMPLETE"};
      lines[at] = std::string("verdict ") + verdicts[random.below(std::size(verdicts))];
    } else if (random.one_in(4)) {
      lines.erase(lines.begin() + std::ptrdiff_t(at));
      return {joined(lines), described(at, before, "")};
    } else if (random.one_in(2)) {
      change_number(lines[at], 0, random);
    } else {
      change_name(lines[at], 0, lines, random);
    }
    if (lines[at] != before) return {joined(lines), described(at, before, lines[at])};
  }
}

/// Changes one line of the question.
Change change_line(const std::string& certificate, Random& random) {
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

}  // namespace

Change change_certificate(const std::string& certificate, Random& random) {
  switch (random.below(12)) {
    case 0:
      return change_everywhere(certificate, true, random);
    case 1:
      return change_everywhere(certificate, false, random);
    case 2:
      return change_kind(certificate, random);
    case 3:
      return change_frame(certificate, random);
    case 4:
      if (const auto change = change_condition(certificate, random)) return *change;
      break;
    case 5: {
      Change changes = change_line(certificate, random);
      for (std::size_t more = 1 + random.below(2); more > 0; --more) {
        Change next = change_line(changes.text, random);
        changes = {std::move(next.text), changes.what + "; " + next.what};
      }
      return changes;
    }
    default:
      break;
  }
  return change_line(certificate, random);
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

}  // namespace regulus::detail::attack
