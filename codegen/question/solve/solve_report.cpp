// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/solve_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/answer/report/set_facts.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/place.hpp"
#include "codegen/question/solve/own_pose.hpp"
#include "codegen/question/solve/platform_legs.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostDigits = 12;
constexpr int kFewestDigits = 3;  ///< fewer say less than the ends of the enclosure
constexpr std::size_t kMostOpenBoxes = 8;

/// Returns the value with the digits that all numbers of the enclosure have when rounded to them;
/// both ends if these are few.
std::string certain_text(const Interval& x) {
  for (int digits = kMostDigits; digits >= kFewestDigits; --digits) {
    const std::string lo = fmt::format("{:.{}g}", x.lo, digits);
    if (lo == fmt::format("{:.{}g}", x.hi, digits)) return lo;
  }
  // About 0 the digits before the first that differs are zeros.
  for (int places = kMostDigits; places >= kFewestDigits; --places) {
    const std::string lo = fmt::format("{:.{}f}", x.lo + 0.0, places);
    const std::string hi = fmt::format("{:.{}f}", x.hi + 0.0, places);
    const auto is_zero = [](const std::string& text) {
      return text.find_first_not_of("-0.") == std::string::npos;
    };
    if (is_zero(lo) && is_zero(hi)) return "0";
  }
  return short_interval(x);
}

const char* sign_text(int sign) { return sign > 0 ? "+" : sign < 0 ? "-" : "?"; }

const char* limits_text(WithinLimits limits) {
  switch (limits) {
    case WithinLimits::kWithin:
      return "within";
    case WithinLimits::kBeyond:
      return "beyond";
    case WithinLimits::kUnknown:
      return "at the border";
    case WithinLimits::kNoLimits:
      break;
  }
  return "";
}

/// A table with columns as wide as their longest entry.
class Table {
 public:
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

  [[nodiscard]] std::string text(std::size_t row) const {
    std::string line;
    for (std::size_t c = 0; c < rows_[row].size(); ++c) {
      std::size_t width = 0;
      for (const auto& other : rows_) width = std::max(width, other[c].size());
      line += fmt::format("{}{:>{}}", c == 0 ? "" : "  ", rows_[row][c], width);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line;
  }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }

 private:
  std::vector<std::vector<std::string>> rows_;
};

std::string heading_of(const SolvedUnknown& unknown) {
  return unknown.unit == "1" ? unknown.name : fmt::format("{} [{}]", unknown.name, unknown.unit);
}

/// The numbers of a solution as people read them, and their names.
std::vector<SolvedUnknown> shown_unknowns(const Solutions& solutions, const OwnPose& own) {
  return own.has_angles() ? own.parameters() : solutions.unknowns;
}

std::vector<Interval> shown_values(const std::vector<Interval>& values, const OwnPose& own) {
  return own.has_angles() ? own.at(values) : values;
}

/// Says the quaternion of each pose whose angles are not determined.
void say_quaternions(const Solutions& solutions, const OwnPose& own, const SolvedNoun& noun,
                     Facts& facts) {
  if (!own.has_angles()) return;
  for (std::size_t i = 0; i < solutions.found.size(); ++i) {
    const std::vector<Interval>& values = solutions.found[i].values;
    if (!own.is_ambiguous(values)) continue;
    std::string quaternion;
    for (std::size_t k = 3; k < values.size(); ++k)
      quaternion += fmt::format("{}{} = {}", k == 3 ? "" : ", ", solutions.unknowns[k].name,
                                certain_text(values[k]));
    facts.say("", fmt::format("{} {}: several angles mean its rotation, the quaternion {}",
                              noun.one, i + 1, quaternion));
  }
}

void say_table(const Solutions& solutions, const OwnPose& own, const SolvedNoun& noun,
               Facts& facts) {
  if (solutions.found.empty()) return;
  const bool has_limits = std::ranges::any_of(solutions.found, [](const CertainSolution& s) {
    return s.limits != WithinLimits::kNoLimits;
  });
  Table table;
  std::vector<std::string> row = {"#"};
  for (const SolvedUnknown& unknown : shown_unknowns(solutions, own))
    row.push_back(heading_of(unknown));
  row.insert(row.end(), {"det", "condition"});
  if (has_limits) row.emplace_back("limits");
  table.add(row);
  for (std::size_t i = 0; i < solutions.found.size(); ++i) {
    const CertainSolution& s = solutions.found[i];
    row = {std::to_string(i + 1)};
    for (const Interval& value : shown_values(s.values, own)) row.push_back(certain_text(value));
    row.insert(row.end(), {sign_text(s.sign), fmt::format("{:.3g}", s.condition)});
    if (has_limits) row.emplace_back(limits_text(s.limits));
    table.add(row);
  }
  for (std::size_t i = 0; i < table.rows(); ++i)
    facts.say(i == 0 ? "solutions" : "", table.text(i));
  for (std::size_t i = 0; i < solutions.found.size(); ++i)
    if (!solutions.found[i].beyond.empty())
      facts.say("", fmt::format("{} {}: {}", noun.one, i + 1, solutions.found[i].beyond));
  say_quaternions(solutions, own, noun, facts);
  facts.say("", fmt::format("det: the sign of the determinant of {}; condition: its condition "
                            "number in the 2-norm, approximately",
                            noun.matrix));
}

Json json_values(const std::vector<SolvedUnknown>& unknowns, const std::vector<Interval>& values) {
  Json result = Json::object();
  for (std::size_t i = 0; i < values.size(); ++i)
    result[unknowns[i].name] = json_interval(values[i]);
  return result;
}

Json json_solution(const Solutions& solutions, const OwnPose& own, const CertainSolution& s) {
  Json result = {{"values", json_values(solutions.unknowns, s.values)}};
  if (own.has_angles()) result["pose"] = json_values(own.parameters(), own.at(s.values));
  result.update(Json{{"determinant", s.sign > 0   ? "positive"
                                     : s.sign < 0 ? "negative"
                                                  : "unknown"},
                     {"condition", std::isfinite(s.condition) ? Json(s.condition) : Json(nullptr)},
                     {"limits", s.limits == WithinLimits::kUnknown    ? "border"
                                : s.limits == WithinLimits::kNoLimits ? "none"
                                                                      : limits_text(s.limits)},
                     {"beyond", s.beyond.empty() ? Json(nullptr) : Json(s.beyond)}});
  return result;
}

Json json_units(const std::vector<SolvedUnknown>& unknowns) {
  Json units = Json::object();
  for (const SolvedUnknown& unknown : unknowns) units[unknown.name] = unknown.unit;
  return units;
}

void add_solutions(const Solutions& solutions, const OwnPose& own, Facts& facts) {
  const bool is_whole = solutions.completeness == Completeness::kComplete;
  Json list = Json::array(), open = Json::array();
  for (const CertainSolution& s : solutions.found) list.push_back(json_solution(solutions, own, s));
  for (const auto& box : solutions.open) open.push_back(json_values(solutions.unknowns, box));
  facts.add("solutions", std::move(list)).add("open_boxes", std::move(open));
  facts.add("complex_solutions", or_null(solutions.complex_found));
  facts.add("how", is_whole ? Json(solutions.how) : Json(nullptr));
  facts.add("obstacle", is_whole ? Json(nullptr) : Json(solutions.obstacle));
  facts.add("stopped_by",
            solutions.stopped_by ? Json(describe(*solutions.stopped_by)) : Json(nullptr));
}

void say_open_boxes(const Solutions& solutions, const OwnPose& own, Facts& facts) {
  const std::vector<SolvedUnknown> unknowns = shown_unknowns(solutions, own);
  const std::size_t shown = std::min(kMostOpenBoxes, solutions.open.size());
  for (std::size_t b = 0; b < shown; ++b) {
    std::string box;
    const std::vector<Interval> values = shown_values(solutions.open[b], own);
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      box += fmt::format("{}{} in {}{}", box.empty() ? "" : ", ", unknowns[i].name,
                         short_interval(values[i]), unit_suffix(unknowns[i].unit));
    facts.say(b == 0 ? "open" : "", box);
  }
  if (shown < solutions.open.size())
    facts.say("", "and " + counted(solutions.open.size() - shown, "more box", "more boxes"));
}

std::string number_of(std::size_t count, const SolvedNoun& noun) {
  return fmt::format("{} {}", count, count == 1 ? noun.one : noun.many);
}

}  // namespace

std::string describe_result(const Solutions& solutions, const SolvedNoun& noun) {
  const std::size_t count = solutions.found.size();
  if (solutions.completeness == Completeness::kIncomplete)
    return fmt::format("INCOMPLETE: at least {}", number_of(count, noun));
  return count == 0 ? "NONE" : fmt::format("COMPLETE: {}", number_of(count, noun));
}

std::string describe_claim(const Solutions& solutions, const SolvedNoun& noun) {
  if (solutions.is_nominal) {
    Solutions exact = solutions;
    exact.is_nominal = false;
    return "with every tolerance and control error at 0, " + describe_claim(exact, noun);
  }
  const std::size_t count = solutions.found.size();
  if (solutions.completeness == Completeness::kIncomplete)
    return fmt::format("{} certain; {}: {}",
                       count == 0   ? "none is"
                       : count == 1 ? fmt::format("1 {} is", noun.one)
                                    : fmt::format("{} {} are", count, noun.many),
                       solutions.changes ? "the number is not always the same"
                                         : "whether there are others is not shown",
                       solutions.obstacle);
  if (count == 0) return fmt::format("there is no {}, {}", noun.one, solutions.how);
  return count == 1 ? fmt::format("this {} is the only one, {}", noun.one, solutions.how)
                    : fmt::format("these {} {} are all, {}", count, noun.many, solutions.how);
}

const char* word_of(const Solutions& solutions) noexcept {
  if (solutions.completeness != Completeness::kComplete) return "incomplete";
  return solutions.found.empty() ? "none" : "complete";
}

std::vector<PlacedValue> placed_values(const Request& request) {
  std::vector<PlacedValue> values;
  for (const PlacedNumber& number : place_of(request.model, request.motion))
    values.push_back({number.name, number.unit, formula_text(number.value),
                      enclose_constant(number.value, number.name)});
  return values;
}

namespace {

Json json_place(const std::vector<PlacedValue>& place) {
  Json numbers = Json::object();
  for (const PlacedValue& number : place)
    numbers[number.name] = {{"exact", number.exact},
                            {"enclosure", json_interval(number.enclosure)},
                            {"unit", number.unit}};
  return numbers;
}

/// Returns "rho_1 = 14.98 cm, rho_2 = 15.38 cm".
std::string describe_place(const std::vector<PlacedValue>& place) {
  std::string text;
  for (const PlacedValue& number : place)
    text += fmt::format("{}{} = {}{}", text.empty() ? "" : ", ", number.name,
                        value_text(number.enclosure), unit_suffix(number.unit));
  return text;
}

Json json_asked(const SolveAsked& asked, Json place) {
  Json question = json_question(asked.request, asked.search);
  if (place.is_null()) {  // each of many places has its own
    question["ranges"] = question["ranges_exact"] = Json::object();
    question.erase("pose_exact");
  } else {
    question["place"] = std::move(place);
  }
  if (!asked.held.empty()) question["held"] = asked.held;
  return question;
}

void say_held(const SolveAsked& asked, Facts& facts) {
  if (!asked.held.empty()) facts.say("held", fmt::format("{}", fmt::join(asked.held, ", ")));
}

}  // namespace

Json checkpointed_question(const SolveAsked& asked, const std::string& places) {
  Json question =
      json_asked(asked, places.empty() ? json_place(placed_values(asked.request)) : Json(nullptr));
  question.erase("options");  // they change how long it takes
  question["solutions"] = places.empty() ? "one place" : places;
  return question;
}

void tell_solutions(const SolveAsked& asked, const Solutions& solutions, const SolvedNoun& noun,
                    Facts& facts) {
  facts.add("verdict", word_of(solutions));
  tell_model(asked.request, facts);
  if (facts.are_for_people()) {
    facts.say("at", describe_place(placed_values(asked.request)));
    if (has_tolerances(asked.request)) say_uncertain(set_of(asked.request).subject, facts);
  }
  say_held(asked, facts);
  for (const std::string& note : asked.request.notes) facts.say("note", note);
  facts.add("notes", asked.request.notes);
  const OwnPose own(asked.request.model);
  say_table(solutions, own, noun, facts);
  if (facts.are_for_programs()) {
    facts.add("solution_units", json_units(solutions.unknowns));
    add_solutions(solutions, own, facts);
  }
  if (solutions.completeness != Completeness::kComplete) say_open_boxes(solutions, own, facts);
  facts.tell("boxes", solutions.boxes, "boxes",
             fmt::format("{} evaluated", in_thousands(solutions.boxes)));
  facts.add("seconds", json_seconds(solutions.seconds));
  facts.say("time", fmt::format("search {:.3f} ms", 1e3 * solutions.seconds));
  const std::string claim = describe_claim(solutions, noun);
  facts.tell("claim", claim, "claim", claim);
  if (facts.are_for_programs())
    add_search(asked.search, json_asked(asked, json_place(placed_values(asked.request))), facts);
}

Json json_solved(const SolvedPlace& place, const Model& model, const SolvedNoun& noun) {
  Facts facts(Readers::kPrograms);
  facts.add("line", place.line);
  if (place.time) facts.add("time", *place.time);
  facts.add("place", json_place(place.place)).add("verdict", word_of(place.solutions));
  add_solutions(place.solutions, OwnPose(model), facts);
  facts.add("boxes", place.solutions.boxes);
  facts.add("claim", describe_claim(place.solutions, noun));
  return facts.object();
}

std::string describe_places(const std::vector<SolvedPlace>& places, std::uint64_t left,
                            const SolvedNoun& noun) {
  const auto count_of = [&places](std::string_view word) {
    return std::ranges::count_if(
        places, [word](const SolvedPlace& place) { return word_of(place.solutions) == word; });
  };
  std::size_t found = 0;
  for (const SolvedPlace& place : places) found += place.solutions.found.size();
  std::string text;
  for (const auto& [word, name] :
       {std::pair{"incomplete", "INCOMPLETE"}, {"none", "NONE"}, {"complete", "COMPLETE"}})
    if (const auto count = count_of(word); count > 0)
      text += fmt::format("{}{} at {}", text.empty() ? "" : ", ", name, count);
  if (left > 0) text += fmt::format("{}not asked at {}", text.empty() ? "" : ", ", left);
  const std::size_t all = places.size() + left;
  return fmt::format("{} of {} place{}: {}{} {}", text, all, all == 1 ? "" : "s",
                     count_of("incomplete") > 0 || left > 0 ? "at least " : "", found,
                     found == 1 ? noun.one : noun.many);
}

std::string describe_time(const SolvedPlace& place, const std::string& unit) {
  if (!place.time) return "";
  return fmt::format(", t = {}{}", shortest_text(*place.time), unit.empty() ? "" : " " + unit);
}

void tell_places_asked(const SolveAsked& asked, const std::vector<SolvedUnknown>& unknowns,
                       Facts& facts) {
  tell_model(asked.request, facts);
  say_held(asked, facts);
  if (!facts.are_for_programs()) return;
  facts.add("solution_units", json_units(unknowns));
  add_search(asked.search, json_asked(asked, nullptr), facts);
}

}  // namespace regulus::detail
