// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/finite_error_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/answer/report/set_facts.hpp"
#include "codegen/model/exact/exact_double.hpp"
#include "codegen/question/bound/bound_number.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

/// Returns "between 0.1 and 0.2 rad"; "at least 0.1 rad" if nothing is proved.
std::string bracket_text(const FiniteError& error, bool in_capitals = false) {
  const auto text = [](double x, RoundTo side) {
    return rounded_text(end_at(exact_number(x)), side);
  };
  const std::string attained = text(error.attained, RoundTo::kBelow);
  const std::string unit = unit_suffix(error.unit);
  if (!std::isfinite(error.proved))
    return fmt::format("{} {}{}", in_capitals ? "AT LEAST" : "at least", attained, unit);
  return fmt::format("{} {} {} {}{}", in_capitals ? "BETWEEN" : "between", attained,
                     in_capitals ? "AND" : "and", text(error.proved, RoundTo::kAbove), unit);
}

/// Returns why a bracket is wider than wanted; empty: it is not.
std::string why_open(const FiniteError& error) {
  if (error.is_closed) return "";
  return error.stopped_by ? describe(*error.stopped_by)
                          : "boxes at the least width are too wide for a narrower bracket";
}

Json json_error(const FiniteErrors& found, const FiniteError& error) {
  Json at = Json::object();
  for (std::size_t k = 0; k < error.place.size(); ++k)
    at[found.parameters[k]] = json_interval(error.place[k]);
  return {{"unknown", error.name},
          {"unit", error.unit},
          {"attained", error.attained},
          {"proved", std::isfinite(error.proved) ? Json(error.proved) : Json(nullptr)},
          {"at", std::move(at)},
          {"closed", error.is_closed},
          {"reason", error.is_closed ? Json(nullptr) : Json(why_open(error))},
          {"boxes", error.boxes}};
}

std::string place_text(const FiniteErrors& found, const FiniteError& error) {
  std::string text;
  for (std::size_t k = 0; k < error.place.size(); ++k)
    text += fmt::format("{}{} = {:.6g}{}", text.empty() ? "at " : ", ", found.parameters[k],
                        mid(error.place[k]), unit_suffix(found.units[k]));
  return text;
}

/// Empty: nothing is proved of any unknown.
std::string describe_claim(const FiniteErrors& found) {
  std::string claim;
  for (const FiniteError& error : found.unknowns)
    if (std::isfinite(error.proved))
      claim += fmt::format("{}|error of {}| <= {}{}", claim.empty() ? "" : ", ", error.name,
                           rounded_text(end_at(exact_number(error.proved)), RoundTo::kAbove),
                           unit_suffix(error.unit));
  if (claim.empty()) return "";
  return claim + " on the branch, at every pose and for all errors within their spreads";
}

}  // namespace

std::string describe_result(const FiniteErrors& found) {
  if (!found.obstacle.empty()) return "NOT BOUNDED";
  std::string text;
  for (const FiniteError& error : found.unknowns)
    text +=
        (text.empty() ? "" : ", ") + fmt::format("{} ({})", bracket_text(error, true), error.name);
  return text;
}

void tell_finite_errors(const Request& request, const SearchOptions& search,
                        const FiniteErrors& found, double gap, bool is_closed, Facts& facts) {
  facts.add("verdict", is_closed ? "closed" : found.folds.empty() ? "open" : "refuted");
  tell_model(request, facts);
  say_set(request, facts);
  facts.say("bound", "error of each unknown, finite: |p(x, e) - p(x, 0)| for all errors e");
  std::uint64_t boxes = found.boxes;
  Json errors = Json::array();
  for (const FiniteError& error : found.unknowns) {
    boxes += error.boxes;
    errors.push_back(json_error(found, error));
    facts.say(error.name,
              fmt::format("{}, {}", bracket_text(error), counted(error.boxes, "box", "boxes")));
    facts.say("", place_text(found, error));
    facts.say("", why_open(error));
  }
  facts.add("errors", std::move(errors)).add("gap_wanted", gap);
  facts.tell("boxes", boxes, "boxes", fmt::format("{} evaluated", boxes));
  facts.add("seconds", Json{{"search", found.seconds}});
  facts.say("time", fmt::format("search {:.3f} ms", 1e3 * found.seconds));
  facts.add("obstacle", nullptr).add("claim", nullptr);
  if (!found.obstacle.empty()) {
    facts.tell("obstacle", found.obstacle, "none", found.obstacle);
  } else if (const std::string claim = describe_claim(found); !claim.empty()) {
    facts.tell("claim", claim, "claim", claim);
  }
  if (facts.are_for_programs()) add_search(search, json_question(request, search), facts);
}

}  // namespace regulus
