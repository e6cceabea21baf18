// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/same_question.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "tests/attack/oracle/evaluate.hpp"

namespace regulus::attack {
namespace {

constexpr int kPoints = 3;
/// Labels, words that follow from the other lines, and lines that change the proof only.
const std::set<std::string> kIgnored{"claim", "model", "sha256", "combined", "norms"};
/// Conditions: their order has no meaning.
const std::set<std::string> kUnordered{"defined", "motion-defined", "reach", "constraint"};

struct Line {
  std::string key, text;
};

/// The lines of a question before `proof`, by their keys.
std::vector<Line> question_of(const std::string& certificate) {
  std::vector<Line> lines;
  std::istringstream stream(certificate);
  std::string text;
  std::getline(stream, text);
  while (std::getline(stream, text) && text != "proof") {
    const std::size_t space = text.find(' ');
    const std::string key = text.substr(0, space);
    if (!kIgnored.contains(key))
      lines.push_back({key, space == std::string::npos ? "" : text.substr(space + 1)});
  }
  return lines;
}

std::vector<std::string> parted(const std::string& text, const std::string& mark) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t at; (at = text.find(mark, begin)) != std::string::npos; begin = at + mark.size())
    parts.push_back(text.substr(begin, at - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

/// A fraction of a range, another one for each quantity and point.
Rational fraction(std::size_t quantity, int point) {
  return Rational(long(7 + 13 * quantity + 31 * std::size_t(point)) % 53, 53);
}

/// The lines of a question as words and values at a point.
class Evaluated {
 public:
  Evaluated(const std::vector<Line>& lines, int point) : point_(point) {
    for (const Line& line : lines) add(line);
  }

  struct Entry {
    std::string words;  ///< the key and what is no expression
    std::vector<Value> values;
  };
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

 private:
  Value value(const std::string& text) const { return evaluate(text, at_); }

  void add(const Line& line) {
    if (line.key == "parameter" || line.key == "uncertain") return add_quantity(line);
    if (line.key == "constant" || line.key == "let") return add_constant(line);
    if (line.key == "pose") return add_pose(line);
    if (line.key == "piecewise") piecewise_ = parted(line.text, " ");
    if (line.key == "piece") return add_piece(line);
    if (line.key == "limits") return add_values(line, parted(line.text, " : "));
    if (line.key == "wrench") return add_values(line, parted(line.text, " +- "));
    static const std::set<std::string> kExpressions{"alpha",
                                                    "entry",
                                                    "scale",
                                                    "defined",
                                                    "motion-defined",
                                                    "reach",
                                                    "constraint",
                                                    "factor",
                                                    "bound",
                                                    "reference",
                                                    "motor-error",
                                                    "stiffness",
                                                    "expression-defined"};
    if (kExpressions.contains(line.key)) return add_values(line, {line.text});
    entries_.push_back({line.key + ' ' + line.text, {}});
  }

  /// The names of all pieces have the values of the last one.
  void add_piece(const Line& line) {
    const auto parts = parted(line.text, " | ");
    add_values(line, parts);
    for (std::size_t i = 0; i < parts.size(); ++i)
      at_[piecewise_.at(i)] = entries_.back().values[i];
  }

  void add_values(const Line& line, const std::vector<std::string>& texts) {
    Entry entry{line.key, {}};
    for (const std::string& text : texts) entry.values.push_back(value(text));
    entries_.push_back(std::move(entry));
  }

  /// "N in E : E" or "N = E +- E".
  void add_quantity(const Line& line) {
    const bool is_range = line.key == "parameter";
    const auto names = parted(line.text, is_range ? " in " : " = ");
    const auto ends = parted(names.at(1), is_range ? " : " : " +- ");
    const Value first = value(ends.at(0)), second = value(ends.at(1));
    const Rational t = fraction(at_.size(), point_);
    at_[names[0]] = is_range ? first + Value(t) * (second - first)
                             : first + Value(t + t - Rational(1)) * second;
    entries_.push_back({line.key + ' ' + names[0], {first, second}});
  }

  void add_constant(const Line& line) {
    const auto parts = parted(line.text, " = ");
    at_[parts[0]] = value(parts.at(1));
    entries_.push_back({line.key + ' ' + parts[0], {at_[parts[0]]}});
  }

  void add_pose(const Line& line) {
    const auto names = parted(line.text, " = ");
    const auto parts = parted(names.at(1), " +- ");
    const Value commanded = value(parts[0]);
    const Value error = parts.size() > 1 ? value(parts[1]) : Value(Rational(0));
    at_[names[0]] = commanded;
    entries_.push_back({line.key + ' ' + names[0], {commanded, error}});
  }

  const int point_;
  Point at_;
  std::vector<std::string> piecewise_;
  std::vector<Entry> entries_;
};

bool is_same(const Value& a, const Value& b) {
  if (a.defined() != b.defined()) return false;
  if (!a.defined()) return true;
  const Value difference = a - b;
  return arb_contains_zero(difference.ball()) != 0;
}

bool is_same(const Evaluated::Entry& a, const Evaluated::Entry& b) {
  return a.words == b.words && a.values.size() == b.values.size() &&
         std::equal(a.values.begin(), a.values.end(), b.values.begin(),
                    [](const Value& x, const Value& y) { return is_same(x, y); });
}

std::string key_of(const Evaluated::Entry& entry) {
  return entry.words.substr(0, entry.words.find(' '));
}

/// A question that states more conditions claims more; one that states fewer claims less.
std::string difference_at(const std::vector<Line>& one, const std::vector<Line>& other, int point) {
  const Evaluated a(one, point), b(other, point);
  std::vector<Evaluated::Entry> left, right;
  for (const auto& e : a.entries())
    if (!kUnordered.contains(key_of(e))) left.push_back(e);
  for (const auto& e : b.entries())
    if (!kUnordered.contains(key_of(e))) right.push_back(e);
  if (left.size() != right.size()) return "another number of lines";
  for (std::size_t i = 0; i < left.size(); ++i)
    if (!is_same(left[i], right[i])) return left[i].words + " against " + right[i].words;
  const auto missing = [](const Evaluated& from, const Evaluated& in) -> std::string {
    for (const auto& e : from.entries()) {
      if (!kUnordered.contains(key_of(e))) continue;
      if (std::none_of(in.entries().begin(), in.entries().end(),
                       [&](const auto& x) { return is_same(e, x); }))
        return "a condition '" + e.words + "'";
    }
    return "";
  };
  const std::string here = missing(a, b);
  return here.empty() ? missing(b, a) : here;
}

}  // namespace

std::string difference(const std::string& one, const std::string& other) try {
  const std::vector<Line> a = question_of(one), b = question_of(other);
  for (int point = 0; point < kPoints; ++point)
    if (const std::string found = difference_at(a, b, point); !found.empty()) return found;
  return "";
} catch (const std::exception& error) {
  return std::string("one is no question: ") + error.what();
}

}  // namespace regulus::attack
