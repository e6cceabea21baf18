// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/question/bound/limit_margin.hpp"
#include "codegen/question/bound/quantity_report.hpp"
#include "codegen/question/margin/margin_report.hpp"
#include "codegen/question/way/trajectory_margin.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

std::string in_brackets(const std::string& label) {
  return label.empty() ? "" : " (" + label + ")";
}

const ComponentMargin* exceeding(const LimitMargin& margin) {
  const ComponentMargin* least = nullptr;
  for (const ComponentMargin& c : margin.components)
    if (c.margin.refuted &&
        (!least || c.margin.refuted->value.approx < least->margin.refuted->value.approx))
      least = &c;
  return least;
}

StageSeconds seconds_of(const LimitMargin& margin) {
  StageSeconds sum;
  for (const ComponentMargin& c : margin.components) sum += c.seconds;
  return sum;
}

Json json_component(const ComponentMargin& c) {
  const auto text = [](const std::optional<MarginStep>& step) {
    return step ? Json(step->value.text) : Json(nullptr);
  };
  Facts facts(Readers::kPrograms);
  facts.add("label", c.component.label);
  facts.add("within", text(c.margin.certified)).add("exceeded", text(c.margin.refuted));
  facts.add("closed", c.margin.closed);
  facts.add("place", c.exceeded ? c.exceeded->json : Json(nullptr));
  facts.add("boxes", c.margin.boxes).add("seconds", json_seconds(c.seconds));
  c.proofs.tell_files(facts);
  return facts.object();
}

void tell_components(const LimitMargin& margin, Facts& facts) {
  Json components = Json::array(), proofs = Json::array();
  for (const ComponentMargin& c : margin.components) {
    components.push_back(json_component(c));
    c.proofs.add_to(proofs, c.component.label);
    facts.say_lines(c.proofs.lines());
  }
  facts.add("components", std::move(components));
  if (!proofs.empty()) facts.add("proof", std::move(proofs));
}

}  // namespace

std::string describe_limit_bracket(const MarginQuestion& question, const LimitMargin& margin) {
  const auto &within = margin.whole.certified, &exceeded = margin.whole.refuted;
  const ComponentMargin* c = exceeding(margin);
  const std::string unit = suffix_of_values(question);
  const std::string name = c ? in_brackets(c->component.label) : "";
  if (within && exceeded)
    return fmt::format("WITHIN UP TO {0}{2}, EXCEEDED AT {1}{2}{3}", within->value.text,
                       exceeded->value.text, unit, name);
  if (exceeded) return fmt::format("EXCEEDED AT {}{}{}", exceeded->value.text, unit, name);
  if (!within && margin.whole.empty)
    return fmt::format("NO POSE REMAINS UP TO {}{}", margin.whole.empty->value.text, unit);
  if (!within) return fmt::format("NOTHING KNOWN FROM {}{} ON", question.low.text, unit);
  const bool all = question.high && within->value.approx == question.high->approx;
  return fmt::format("WITHIN UP TO {}{}{}", within->value.text, unit,
                     all ? "" : ", NOTHING KNOWN ABOVE");
}

void tell_limit_margin(const Request& request, const MarginQuestion& question,
                       const LimitMargin& margin, const LimitMarginSettings& settings,
                       Facts& facts) {
  const std::string limit = describe_limit(margin.quantity, settings.limit);
  if (request.motion.trajectory) {
    add_model(request, facts);
    if (facts.are_for_people())
      facts.say_lines(
          text_of_facts([&](Facts& lines) { tell_growing_way(request, question, lines); }));
  } else {
    tell_model(request, facts);
    say_set(request, question, facts);
  }
  facts.say("margin", describe_range(question)).tell("limit", limit, "limit", limit);
  facts.add("limit_exact", formula_text(settings.limit));
  facts.add("quantity", json_quantity(request.model, margin.quantity));
  add_bracket(question, margin.whole, facts);
  facts.add("bracket", describe_limit_bracket(question, margin));
  if (request.motion.trajectory) facts.add("waypoints", json_waypoints(*request.motion.trajectory));
  facts.say("boxes", fmt::format("{} evaluated", margin.whole.boxes));
  tell_time(seconds_of(margin), facts);
  if (const ComponentMargin* c = exceeding(margin); c && c->exceeded) {
    const std::string& label = c->component.label;
    facts.say("exceeded", (label.empty() ? "" : label + ": ") + c->exceeded->pose);
    facts.say_lines(c->exceeded->values);
  }
  tell_gap(margin.whole, settings.gap, facts);
  tell_components(margin, facts);
  if (facts.are_for_programs())
    add_search(settings.search, json_question(request, settings.search), facts);
}

}  // namespace regulus::detail
