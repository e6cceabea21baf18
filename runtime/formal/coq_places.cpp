// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_places.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/formal/coq_claim.hpp"
#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_load.hpp"
#include "runtime/formal/coq_poses.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/formal/coq_solutions.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/solution_lines.hpp"

namespace regulus::verifier {
namespace {

/// A number of a line: E of `constant N = E`, or one of both of `unknown N = E +- E`.
struct NumberOfLine {
  std::size_t line, part;
};

/// Returns the line up to its first number, and its numbers.
std::vector<std::string> split_numbers(std::string_view line) {
  constexpr auto kKeys =
      std::to_array<std::string_view>({"constant ", "uncertain ", "pose ", "unknown "});
  if (std::ranges::none_of(kKeys, [&](std::string_view key) { return line.starts_with(key); }))
    return {std::string(line)};
  std::vector<std::string> parts{std::string(take_until(line, " = ")) + " = "};
  while (!line.empty()) parts.emplace_back(take_until(line, " +- "));
  return parts;
}

/// The parts of a certificate about the places of a table have the same lines but for some numbers.
class PlacesWriter {
 public:
  void add(std::size_t k, ListedConfigurations place) {
    std::vector<std::vector<std::string>> lines;
    for (const std::string& line : place.lines)
      if (!is_about_solutions(line)) lines.push_back(split_numbers(line));
    if (k > 0) compare(lines_.front(), lines);
    lines_.push_back(std::move(lines));
    const std::string list = coq_solutions(place.question, std::string(6, ' '));
    lists_.push_back(
        (place.question.solutions->verdict == format::kIncomplete ? "Some_of" : "All_of") +
        ((list == "[]" ? " " : "\n     ") + list));
    count(place.question);
    if (k == 0) first_ = std::move(place);
  }

  [[nodiscard]] const Question& first() const { return first_.question; }

  /// Requires: there is a place.
  std::string text() {
    if (numbers_.empty()) take_any_number();
    std::ranges::sort(numbers_, {},
                      [](const NumberOfLine& n) { return std::pair(n.line, n.part); });
    std::vector<std::string> names;
    std::string comment;
    for (const NumberOfLine& number : numbers_) {
      names.push_back(free_name("place_" + std::to_string(names.size() + 1), first_.lines));
      comment += (comment.empty() ? "" : ", ") + describe(number);
    }
    std::vector<CoqItem> places;
    for (std::size_t k = 0; k < lines_.size(); ++k)
      places.push_back({"", "(" + values_at(k) + ", " + lists_[k] + ")"});
    return coq_heading(first_.question, format::describe_places_claim(claimed_)) +
           coq_question(lines_with(names), first_.question, names).text +
           "\n(** The places; at each the values of " + coq_comment(comment) +
           ", and what is listed there: an\n    interval for each unknown. *)\n"
           "Definition the_places : list (list expression * listed) :=\n  " +
           coq_list(places, "   ") + ".\n" + method_of_search(first_.question) +
           coq_claim("solutions_at the_closure the_places",
                     "check_solutions_at_correct the_closure the_method the_places");
  }

 private:
  static bool is_about_solutions(std::string_view line) {
    return line.starts_with("verdict ") || line.starts_with("claim ") ||
           line.starts_with("solution ");
  }

  /// Adds the numbers that differ.
  void compare(const std::vector<std::vector<std::string>>& a,
               const std::vector<std::vector<std::string>>& b) {
    if (a.size() != b.size()) refuse();
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i].size() != b[i].size()) refuse();
      for (std::size_t part = 0; part < a[i].size(); ++part) {
        if (a[i][part] == b[i][part]) continue;
        if (part == 0) refuse();
        const auto is_same = [&](const NumberOfLine& n) { return n.line == i && n.part == part; };
        if (std::ranges::none_of(numbers_, is_same)) numbers_.push_back({i, part});
      }
    }
  }
  [[noreturn]] static void refuse() {
    throw Unfinished(
        "there is no theorem about places that differ in more than numbers of their lines yet");
  }

  /// All places have the same numbers: one of them is written.
  void take_any_number() {
    for (std::size_t i = 0; numbers_.empty(); ++i)
      if (lines_.front()[i].size() > 1) numbers_.push_back({i, 1});
  }

  void count(const Question& question) {
    const std::string& verdict = question.solutions->verdict;
    claimed_.complete += verdict == format::kComplete;
    claimed_.none += verdict == format::kNone;
    claimed_.incomplete += verdict == format::kIncomplete;
    claimed_.solutions += question.solutions->solutions.size();
  }

  /// `theta`, or `the range of phi`.
  [[nodiscard]] std::string describe(const NumberOfLine& number) const {
    std::string_view words = lines_.front()[number.line].front();
    const std::string_view key = take_until(words, " ");
    const std::string name(take_until(words, " "));
    if (key == "unknown") return (number.part == 1 ? "the middle for " : "the radius for ") + name;
    return number.part == 1 ? name : "what " + name + " is uncertain by";
  }

  [[nodiscard]] std::string values_at(std::size_t k) const {
    std::string text;
    for (const NumberOfLine& number : numbers_)
      text += (text.empty() ? "[" : "; ") + coq_expression(lines_[k][number.line][number.part], {});
    return text + "]";
  }

  /// The lines of the first place, with names for these numbers.
  [[nodiscard]] std::vector<std::string> lines_with(const std::vector<std::string>& names) const {
    std::vector<std::vector<std::string>> lines = lines_.front();
    for (std::size_t n = 0; n < names.size(); ++n)
      lines[numbers_[n].line][numbers_[n].part] = names[n];
    std::vector<std::string> written;
    for (const std::vector<std::string>& parts : lines) {
      std::string line = parts.front();
      for (std::size_t part = 1; part < parts.size(); ++part)
        line += (part == 1 ? "" : " +- ") + parts[part];
      written.push_back(std::move(line));
    }
    return written;
  }

  ListedConfigurations first_;
  std::vector<std::vector<std::vector<std::string>>> lines_;  ///< by place, split
  std::vector<std::string> lists_;                            ///< by place
  std::vector<NumberOfLine> numbers_;                         ///< those that differ
  format::ClaimedPlaces claimed_;
};

/// Calls `add` for each part, up to the end of the file. Throws Rejection.
template <class Add>
void read_parts(Lines& lines, Add add) {
  const auto advance = [&] {
    if (!lines.next()) throw Rejection("the file ends before its line 'places'");
  };
  std::size_t k = 0;
  const auto is_next = [&] {
    return lines.text().starts_with(format::kPlace) || lines.text().starts_with(format::kPlaces);
  };
  for (advance(); lines.text() == format::kPlace + std::to_string(k + 1); ++k) {
    advance();
    if (is_next()) throw Unfinished("place " + std::to_string(k + 1) + " has no proof");
    lines.repeat();
    Question question;
    lines.keep();
    read_question(lines, question);
    if (!question.solutions) throw Rejection("a part of it lists no solutions");
    add(k, question, lines.take_kept());
    while (!is_next()) {
      if (lines.text().starts_with(kFromLine)) throw Unfinished(kNoTheoremOfFollowed);
      advance();
    }
  }
  if (k == 0 || lines.text() != format::kPlaces + std::to_string(k) || lines.next())
    throw Rejection("expected the next place, or the number of all in a line 'places'");
}

}  // namespace

std::string places_theorem(Lines& lines, Question& first) {
  PlacesWriter writer;
  read_parts(lines, [&](std::size_t k, const Question& question, const auto& part) {
    writer.add(k, configurations_of(question, part, SquaresOfLegs::kConstants));
  });
  first = writer.first();
  return writer.text();
}

}  // namespace regulus::verifier
