// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/margin/margin_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/answer/report/set_facts.hpp"
#include "codegen/answer/report/witness_report.hpp"
#include "codegen/model/exact/decimal.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// Returns a decimal as written, another value as the bound that claims less.
Json json_value(const std::optional<MarginStep>& step, bool round_up) {
  if (!step) return nullptr;
  const MarginValue& value = step->value;
  if (value.exact.is_equal(shortest_decimal(value.approx))) return value.approx;
  const Interval enclosure = enclose_constant(value.exact, value.text);
  return round_up ? enclosure.hi : enclosure.lo;
}

Json json_text(const std::optional<MarginStep>& step) {
  return step ? Json(step->value.text) : Json(nullptr);
}

const char* name_of_quantity(MarginQuantity quantity) {
  switch (quantity) {
    case MarginQuantity::kTolerance:
      return "tolerance";
    case MarginQuantity::kAlpha:
      return "alpha";
    case MarginQuantity::kScale:
      return "scale";
    case MarginQuantity::kParameter:
      return "parameter";
    case MarginQuantity::kTube:
      return "tube";
  }
  return "";
}

Json json_question(const MarginQuestion& question) {
  Json object = {{"kind", name_of_quantity(question.quantity)}};
  if (question.quantity == MarginQuantity::kTolerance) object["groups"] = question.groups;
  if (question.quantity == MarginQuantity::kParameter) object["parameter"] = question.groups;
  if (question.quantity == MarginQuantity::kTube && !question.groups.empty())
    object["parameters"] = question.groups.substr(0, question.groups.size() - 1);
  object["unit"] = question.unit.empty() ? Json(nullptr) : Json(question.unit);
  object["low"] = question.low.text;
  object["high"] = question.high ? Json(question.high->text) : Json(nullptr);
  return object;
}

/// A limit, or a threshold, is exceeded where the matrix need not be singular.
const char* word_of_step(const MarginQuestion& question, Verdict verdict) {
  if (verdict == Verdict::kPossibleProblem) return name(verdict);
  const bool holds = verdict == Verdict::kNoSingularity;
  if (!question.limit.empty()) return holds ? "WITHIN" : "EXCEEDED";
  if (question.has_threshold) return holds ? "SAFE" : "NOT SAFE";
  return name(verdict);
}

const char* json_word_of_step(const MarginQuestion& question, Verdict verdict) {
  if (question.limit.empty() || verdict == Verdict::kPossibleProblem) return json_name(verdict);
  return verdict == Verdict::kNoSingularity ? "within" : "exceeded";
}

/// Returns the reason in the words of the question: the search for a limit speaks of another matrix.
const char* reason_of_step(const MarginQuestion& question, const Result& result) {
  if (!question.limit.empty() && result.verdict == Verdict::kSingularity)
    return "a pose where the limit is reached";
  return describe(result.reason);
}

Json json_steps(const MarginQuestion& question, const Margin& margin) {
  Json steps = Json::array();
  for (const MarginStep& step : margin.steps)
    steps.push_back({{"value", step.value.approx},
                     {"exact", step.value.text},
                     {"verdict", json_word_of_step(question, step.result.verdict)},
                     {"reason", reason_of_step(question, step.result)},
                     {"nonempty", json_occupancy(step.result)},
                     {"boxes", step.result.statistics.boxes},
                     {"seconds", step.result.statistics.seconds}});
  return steps;
}

/// Removes a variable of the motion.
void leave_out(SearchSubject& set, const std::string& name) {
  auto& variables = set.labels.variables;
  const auto at = std::ranges::find(variables, name, &VariableLabel::name);
  if (at == variables.end()) return;
  const auto index = at - variables.begin();
  variables.erase(at);
  set.variety.outer.erase(set.variety.outer.begin() + index);
  set.variety.inner.erase(set.variety.inner.begin() + index);
}

std::string reason_to_end(const Margin& margin) {
  if (margin.closed && margin.certified && !margin.refuted) return "all of the range is safe";
  if (margin.closed && margin.refuted && !margin.certified) return "the lower end is not safe";
  if (margin.closed) return "the bracket is as narrow as wanted";
  if (margin.interrupted) return "the run was interrupted";
  if (const std::string obstacle = obstacle_of(margin); !obstacle.empty())
    return "a search between the ends decided nothing: " + obstacle;
  return "no search between the ends was likely to end within the time left";
}

}  // namespace

std::string suffix_of_values(const MarginQuestion& question) {
  return question.quantity == MarginQuantity::kScale ? " times the ranges"
                                                     : unit_suffix(question.unit);
}

std::string describe_bracket(const MarginQuestion& question, const Margin& margin) {
  const std::optional<MarginStep>& certified = margin.certified;
  const std::optional<MarginStep>& refuted = margin.refuted;
  const std::string unit = suffix_of_values(question);
  if (certified && refuted)
    return fmt::format("SAFE UP TO {0}{2}, NOT AT {1}{2}", certified->value.text,
                       refuted->value.text, unit);
  if (refuted) return fmt::format("NOT SAFE AT {}{}", refuted->value.text, unit);
  if (!certified && margin.empty)
    return fmt::format("NO POSE REMAINS UP TO {}{}", margin.empty->value.text, unit);
  if (!certified) return fmt::format("NOTHING KNOWN FROM {}{} ON", question.low.text, unit);
  const bool all = question.high && certified->value.approx == question.high->approx;
  return fmt::format("SAFE UP TO {}{}{}", certified->value.text, unit,
                     all ? "" : ", NOTHING KNOWN ABOVE");
}

std::string format_step(const MarginQuestion& question, const MarginStep& step) {
  const Result& result = step.result;
  std::string line = fmt::format(
      "{:<13} {:<16} {:>9} {:<5} {:>8.2f} s", step.value.text + unit_suffix(question.unit),
      word_of_step(question, result.verdict), result.statistics.boxes,
      result.statistics.boxes == 1 ? "box" : "boxes", result.statistics.seconds);
  if (result.verdict == Verdict::kPossibleProblem)
    line += fmt::format("   {}", describe(result.reason));
  if (result.verdict == Verdict::kSingularity && result.statistics.boxes == 0)
    line += "   a witness found beforehand";
  return line + "\n";
}

std::string verdict_of(const MarginQuestion& question, const Margin& margin) {
  if (margin.refuted && margin.refuted->value.approx <= question.low.approx) return "refuted";
  return margin.closed && margin.certified ? "closed" : "open";
}

std::string describe_range(const MarginQuestion& question) {
  return fmt::format("{}, from {} to {}{}", describe_quantity(question), question.low.text,
                     question.high ? question.high->text : "where it ends",
                     question.unit.empty() ? "" : ", in " + question.unit);
}

void say_set(const Request& nominal, const MarginQuestion& question, Facts& facts) {
  if (!facts.are_for_people()) return;
  SearchSubject set = set_of(before_growth(nominal, question)).subject;
  if (question.quantity == MarginQuantity::kParameter) {
    facts.say("", describe_growing_range(nominal, question));
    leave_out(set, question.groups);
  }
  say_poses(set, nominal, facts);
  say_where(set, facts);
  if (grows_from_0(question))
    say_growing(set, set_of(grown(nominal, question, forming_value(question))).subject, facts);
  else
    say_uncertain(set, facts);
}

void say_end(const MarginQuestion& question, const std::optional<MarginStep>& step, Facts& facts) {
  if (step)
    facts.say(fmt::format("at {}{}:", step->value.text, suffix_of_values(question)), step->claim);
}

void tell_gap(const Margin& margin, double gap_wanted, Facts& facts) {
  facts.add("gap", or_null(margin.gap)).add("gap_wanted", gap_wanted);
  if (margin.gap) facts.say("gap", fmt::format("{:.3g} % of the upper end", 100 * *margin.gap));
}

void add_bracket(const MarginQuestion& question, const Margin& margin, Facts& facts) {
  std::string claim;
  for (const auto* step : {&margin.certified, &margin.refuted})
    if (*step)
      claim += fmt::format("{}at {}{}: {}", claim.empty() ? "" : "; ", (*step)->value.text,
                           suffix_of_values(question), (*step)->claim);
  facts.add("claim", claim.empty() ? Json(nullptr) : Json(claim));
  facts.add("verdict", verdict_of(question, margin)).add("reason", reason_to_end(margin));
  facts.add("margin", json_question(question)).add("bracket", describe_bracket(question, margin));
  facts.add("certified", json_value(margin.certified, false));
  facts.add("certified_exact", json_text(margin.certified));
  facts.add("certified_claim", margin.certified ? Json(margin.certified->claim) : Json(nullptr));
  facts.add("nonempty", margin.refuted     ? Json(true)
                        : margin.certified ? json_occupancy(margin.certified->result)
                        : margin.empty     ? Json(false)
                                           : Json(nullptr));
  facts.add("refuted", json_value(margin.refuted, true));
  facts.add("refuted_exact", json_text(margin.refuted));
  facts.add("refuted_claim", margin.refuted ? Json(margin.refuted->claim) : Json(nullptr));
  facts.add("closed", margin.closed)
      .add("boxes", margin.boxes)
      .add("steps", json_steps(question, margin));
}

void tell_margin(const PreparedSearch& p, const SearchOptions& search, const Request& nominal,
                 const MarginQuestion& question, const Margin& margin, double gap_wanted,
                 Facts& facts) {
  tell_model(p, facts);
  say_set(nominal, question, facts);
  facts.say("margin", describe_range(question));
  tell_method(p, search, search.method, margin.boxes, facts);
  facts.say("boxes", fmt::format("{} evaluated at {}", margin.boxes,
                                 counted(margin.steps.size(), "value", "values")));
  tell_time(p.seconds_spent(), facts);
  say_end(question, margin.empty, facts);
  say_end(question, margin.certified, facts);
  if (margin.certified) tell_occupancy(margin.certified->result, facts);
  add_bracket(question, margin, facts);
  say_end(question, margin.refuted, facts);
  tell_witness(p, margin.refuted ? margin.refuted->result : Result{}, facts);
  tell_gap(margin, gap_wanted, facts);
  facts.say("ended", reason_to_end(margin));
  if (facts.are_for_programs()) add_search(search, json_question(nominal, search), facts);
}

}  // namespace regulus::detail
