// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/same_question.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "tests/attack/forge/words.hpp"
#include "tests/attack/oracle/evaluate.hpp"

namespace regulus::detail::attack {
namespace {

constexpr int kPoints = 3, kSpecialPoints = 48;
/// Labels, what is the claim and not the file's, and lines that change the proof only.
const std::set<std::string> kIgnored{"model",     "sha256",   "combined",   "norms",
                                     "reference", "solution", "joint-range"};
/// Their words are labels, not names of quantities.
const std::set<std::string> kLabelled{"load", "twist", "quantity", "side"};
/// Not compared line by line: the claim says that all of them have a value. Of an expression, this is the
/// claim and not the file's.
const std::set<std::string> kConditions{"defined", "motion-defined", "expression-defined"};
/// The values of these are in those of the other lines.
const std::set<std::string> kShorthand{"let", "constant"};
/// Their order has no meaning.
const std::set<std::string> kUnordered{"parameter", "uncertain",  "pose",
                                       "unknown",   "constraint", "ball"};

struct Line {
  std::string key, text;
};

/// The lines of a question before `proof`, by their keys; a line `reach` that says the same as an
/// earlier one changes no set.
std::vector<Line> question_of(const std::string& certificate) {
  std::vector<Line> lines;
  std::istringstream stream(certificate);
  std::set<std::string> reach;
  std::string text;
  std::getline(stream, text);
  while (std::getline(stream, text) && text != "proof") {
    const std::size_t space = text.find(' ');
    const std::string key = text.substr(0, space);
    if (key == "reach" && !reach.insert(text).second) continue;
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

/// The names of the quantities, in the order of their lines.
std::vector<std::string> names_of(const std::vector<Line>& lines) {
  std::vector<std::string> names;
  for (const char* key : {"parameter", "uncertain", "pose", "unknown"})
    for (const Line& line : lines)
      if (line.key == key) names.push_back(line.text.substr(0, line.text.find(' ')));
  return names;
}

/// Puts other names into all lines at once: `from[i]` becomes `to[i]`. Where `to[i]` stands already
/// and is no name of `from`, it gets a name that nothing has.
std::vector<Line> renamed(std::vector<Line> lines, const std::vector<std::string>& from,
                          const std::vector<std::string>& to) {
  std::map<std::string, std::string> names;
  for (const std::string& name : to) names[name] = name + "_of_nothing";
  for (std::size_t i = 0; i < from.size(); ++i) names[from[i]] = to[i];
  for (Line& line : lines) {
    if (kLabelled.contains(line.key)) continue;
    std::string text;
    for (std::size_t i = 0; i < line.text.size();) {
      std::size_t end = i;
      while (end < line.text.size() && is_word(line.text[end])) ++end;
      const std::string word = line.text.substr(i, end - i);
      const auto name = names.find(word);
      text += name == names.end() ? word : name->second;
      if (end == i) text += line.text[end++];
      i = end;
    }
    line.text = std::move(text);
  }
  return lines;
}

unsigned long hash(const std::string& name, int point) {
  unsigned long sum = 7 + 31 * static_cast<unsigned long>(point);
  for (const char c : name) sum = sum * 31 + static_cast<unsigned char>(c);
  return sum;
}

/// Values at which operations lose theirs, whatever the ranges are; the same for all names, or others.
Rational special(const std::string& name, int point) {
  const long values[] = {0, 0, 1, -1, 2, -2, 4, -4, 6, -9, 100, -100};
  const bool are_alike = point % 3 == 0;
  return {values[hash(are_alike ? "" : name, point) % std::size(values)], 2};
}

/// A fraction of a range, another one for each name and point.
Rational fraction(const std::string& name, int point) {
  return {static_cast<long>(hash(name, point) % 53), 53};
}

/// The lines of a question as words and values at a point.
class Evaluated {
 public:
  /// `piece`: which of them, if there are pieces.
  Evaluated(const std::vector<Line>& lines, std::size_t piece, int point, const SetByOptions& any,
            bool is_special = false)
      : piece_(piece), point_(point), any_(any), is_special_(is_special) {
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
    static const std::set<std::string> kQuantities{"parameter", "uncertain", "unknown"};
    if (kQuantities.contains(line.key)) return add_quantity(line);
    if (line.key == "constant" || line.key == "let") return add_constant(line);
    if (line.key == "pose") return add_pose(line);
    if (line.key == "piecewise") return begin_pieces(line);
    if (line.key == "piece") return add_piece(line);
    static const std::set<std::string> kLists{"leg",
                                              "joint",
                                              "held-joint",
                                              "sliding-joint",
                                              "held-sliding-joint",
                                              "following-joint",
                                              "following-sliding-joint",
                                              "turning-tool",
                                              "tip",
                                              "tool"};
    if (kLists.contains(line.key)) return add_values(line, parted(line.text, " | "));
    if (line.key == "limits") return add_values(line, parted(line.text, " : "));
    if (line.key == "wrench") return add_values(line, parted(line.text, " +- "));
    static const std::set<std::string> kExpressions{
        "alpha",          "entry",       "scale",      "defined",
        "motion-defined", "reach",       "constraint", "factor",
        "bound",          "motor-error", "stiffness",  "expression-defined",
        "start",          "equation",    "joint-value"};
    if (kExpressions.contains(line.key)) return add_values(line, {line.text});
    entries_.push_back({line.key + ' ' + line.text, {}});
  }

  /// The names have no meaning beside the lines that use them.
  void begin_pieces(const Line& line) {
    piecewise_ = parted(line.text, " ");
    entries_.push_back({line.key, {}});
  }

  /// Its values count by the lines that use them: one of them may be multiplied by 0.
  void add_piece(const Line& line) {
    entries_.push_back({line.key, {}});
    if (pieces_++ != piece_) return;
    const auto parts = parted(line.text, " | ");
    for (std::size_t i = 0; i < parts.size(); ++i) at_[piecewise_.at(i)] = value(parts[i]);
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
    const Rational t = fraction(names[0], point_);
    const bool is_any = any_.tolerances && line.key == "uncertain";
    const Value spread = is_any ? Value(Rational(0)) : second;
    at_[names[0]] = is_range ? first + Value(t) * (second - first)
                             : first + Value(t + t - Rational(1)) * spread;
    if (is_special_) at_[names[0]] = Value(special(names[0], point_));
    entries_.push_back({line.key + ' ' + names[0], {first, is_range ? second : spread}});
  }

  void add_constant(const Line& line) {
    const auto parts = parted(line.text, " = ");
    at_[parts[0]] = value(parts.at(1));
  }

  void add_pose(const Line& line) {
    const auto names = parted(line.text, " = ");
    const auto parts = parted(names.at(1), " +- ");
    const Value commanded = value(parts[0]);
    const Value error = parts.size() > 1 ? value(parts[1]) : Value(Rational(0));
    at_[names[0]] = commanded;
    entries_.push_back({line.key + ' ' + names[0], {commanded, error}});
  }

  const std::size_t piece_;
  const int point_;
  const SetByOptions any_;
  const bool is_special_;
  Point at_;
  std::vector<std::string> piecewise_;
  std::size_t pieces_ = 0;
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

/// The lines but for entries, in their order; those whose order has no meaning by their words.
struct Parts {
  std::vector<Evaluated::Entry> ordered, unordered, reach;
  std::vector<Value> matrix;
  bool has_threshold = false;

  Parts(const Evaluated& question, const SetByOptions& any) {
    for (const Evaluated::Entry& entry : question.entries()) {
      const std::string key = key_of(entry);
      if (key == "alpha")
        has_threshold = !(entry.values[0].exact() && entry.values[0].exact()->is_zero());
      if (kConditions.contains(key) || (key == "alpha" && any.alpha)) continue;
      if (key == "entry")
        matrix.push_back(entry.values.front());
      else if (key == "reach")
        reach.push_back(entry);
      else
        (kUnordered.contains(key) ? unordered : ordered).push_back(entry);
    }
    std::stable_sort(unordered.begin(), unordered.end(),
                     [](const auto& a, const auto& b) { return a.words < b.words; });
  }

  /// Claims of regularity depend on the zeros of the determinant alone.
  [[nodiscard]] bool asks_for_regularity() const {
    return !has_threshold &&
           std::none_of(ordered.begin(), ordered.end(), [](const Evaluated::Entry& entry) {
             const std::string key = key_of(entry);
             return key == "load" || key == "quantity" || key == "scale";
           });
  }
  [[nodiscard]] std::optional<Value> determinant() const {
    std::size_t order = 0;
    while (order * order < matrix.size()) ++order;
    if (order * order != matrix.size()) return std::nullopt;
    Matrix rows(order);
    for (std::size_t i = 0; i < matrix.size(); ++i) rows[i / order].push_back(matrix[i]);
    return attack::determinant(rows);
  }
};

std::string difference_of(const std::vector<Evaluated::Entry>& a,
                          const std::vector<Evaluated::Entry>& b) {
  if (a.size() != b.size()) return "another number of lines";
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!is_same(a[i], b[i])) return a[i].words + " against " + b[i].words;
  return "";
}

/// With fewer lines `reach` a claim is about more poses, at which the matrix has a value all the same.
bool are_among(const std::vector<Evaluated::Entry>& verified,
               const std::vector<Evaluated::Entry>& asked) {
  return std::all_of(verified.begin(), verified.end(), [&](const Evaluated::Entry& a) {
    return std::any_of(asked.begin(), asked.end(),
                       [&a](const Evaluated::Entry& b) { return is_same(a, b); });
  });
}

/// True if everything that a claim says to have a value has one; nullopt for a point that is out of
/// reach.
std::optional<bool> is_defined(const std::vector<Line>& lines, std::size_t piece, int point,
                               const SetByOptions& any) {
  static const std::set<std::string> kNoEntries{"expression", "speed", "sigma-min", "sigma-max"};
  bool claims_entries = true, has_load = false;
  for (const Line& line : lines) {
    if (line.key == "quantity") claims_entries = !kNoEntries.contains(line.text);
    has_load |= line.key == "load";
  }
  bool all = true;
  const Evaluated evaluated(lines, piece, point, any, true);
  for (const Evaluated::Entry& entry : evaluated.entries()) {
    const std::string key = key_of(entry);
    if (key == "reach" &&
        (!entry.values[0].defined() || !entry.values[0].certain_at_least(Rational(0))))
      return std::nullopt;
    const bool is_claimed = key == "defined" || key == "motion-defined" || key == "pose" ||
                            (key == "entry" && claims_entries) || (key == "scale" && has_load);
    for (const Value& value : entry.values) all = all && (!is_claimed || value.defined());
  }
  return all;
}

/// Returns true unless `asked` has no value at a point where the other says that there is one.
bool claims_domain(const std::vector<Line>& verified, const std::vector<Line>& asked,
                   std::size_t piece, const SetByOptions& any) {
  for (int point = 0; point < kSpecialPoints; ++point) {
    const auto first = is_defined(verified, piece, point, any),
               second = is_defined(asked, piece, point, any);
    if (first && second && *first && !*second) return false;
  }
  return true;
}

bool have_one_ratio(const std::vector<std::pair<Value, Value>>& determinants) {
  const Value &a = determinants.front().first, &b = determinants.front().second;
  return std::all_of(determinants.begin(), determinants.end(),
                     [&](const auto& other) { return is_same(a * other.second, b * other.first); });
}

std::string difference_of(const std::vector<Line>& a, const std::vector<Line>& b, std::size_t piece,
                          const SetByOptions& any) {
  std::vector<std::pair<Value, Value>> determinants;
  bool has_one_matrix = true, is_about_zeros = true;
  for (int point = 0; point < kPoints; ++point) {
    const Parts left(Evaluated(a, piece, point, any), any),
        right(Evaluated(b, piece, point, any), any);
    for (const auto& found : {difference_of(left.ordered, right.ordered),
                              difference_of(left.unordered, right.unordered)})
      if (!found.empty()) return found;
    if (!are_among(left.reach, right.reach)) return "another line reach";
    has_one_matrix =
        has_one_matrix &&
        std::equal(left.matrix.begin(), left.matrix.end(), right.matrix.begin(), right.matrix.end(),
                   [](const Value& x, const Value& y) { return is_same(x, y); });
    const auto first = left.determinant(), second = right.determinant();
    is_about_zeros = is_about_zeros && left.asks_for_regularity() && first && second;
    if (is_about_zeros) determinants.emplace_back(*first, *second);
  }
  if (!claims_domain(a, b, piece, any)) return "it does not say where there is a value";
  if (has_one_matrix || (is_about_zeros && have_one_ratio(determinants))) return "";
  return "another matrix";
}

std::string difference_of(const std::vector<Line>& a, const std::vector<Line>& b,
                          const SetByOptions& any) try {
  const auto pieces =
      std::count_if(a.begin(), a.end(), [](const Line& line) { return line.key == "piece"; });
  std::string found = difference_of(a, b, 0, any);
  for (std::ptrdiff_t piece = 1; piece < pieces && found.empty(); ++piece)
    found = difference_of(a, b, std::size_t(piece), any);
  return found;
} catch (const std::exception& error) {
  return std::string("one is no question: ") + error.what();
}

/// The sides of cuts of atan2, pieces of 1 and -1, are asked about together, in whatever order.
std::vector<Line> with_sides_in_order(std::vector<Line> lines) {
  std::vector<std::string> sides;
  for (const Line& line : lines)
    if (line.key == "piece") sides.push_back(line.text);
  for (const std::string& side : sides)
    for (const std::string& part : parted(side, " | "))
      if (part != "1" && part != "-1") return lines;
  std::ranges::sort(sides);
  std::size_t next = 0;
  for (Line& line : lines)
    if (line.key == "piece") line.text = sides[next++];
  return lines;
}

}  // namespace

std::string difference(const std::string& verified, const std::string& asked,
                       const SetByOptions& any) {
  const std::vector<Line> a = with_sides_in_order(question_of(verified)),
                          b = with_sides_in_order(question_of(asked));
  const std::string found = difference_of(a, b, any);
  const auto from = names_of(a), to = names_of(b);
  if (found.empty() || from == to || from.size() != to.size()) return found;
  return difference_of(renamed(a, from, to), b, any);
}

}  // namespace regulus::detail::attack
