// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report_parts.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/question/bound/limit_margin.hpp"
#include "codegen/question/bound/quantity_report.hpp"
#include "codegen/question/margin/margin_report.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus {
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
  Json object = {{"label", c.component.label},
                 {"within", text(c.margin.certified)},
                 {"exceeded", text(c.margin.refuted)},
                 {"closed", c.margin.closed},
                 {"place", c.exceeded ? c.exceeded->json : Json(nullptr)},
                 {"boxes", c.margin.boxes},
                 {"seconds", json_seconds(c.seconds)}};
  c.proofs.add_to(object);
  return object;
}

}  // namespace

std::string describe_limit(const Quantity& quantity, const GiNaC::ex& limit) {
  const Component& c = quantity.components.front();
  const bool least = quantity.is_least || c.kind == QuantityKind::kSigmaMin ||
                     c.kind == QuantityKind::kDeterminant;
  return fmt::format("{} {} {}{}", quantity.name, least ? ">" : "<", formula_text(limit),
                     quantity.unit == "1" ? "" : " " + quantity.unit);
}

std::string describe_limit_bracket(const MarginQuestion& question, const LimitMargin& margin) {
  const auto &within = margin.whole.certified, &exceeded = margin.whole.refuted;
  const ComponentMargin* c = exceeding(margin);
  const std::string name = c ? in_brackets(c->component.label) : "";
  if (within && exceeded)
    return fmt::format("WITHIN UP TO {}, EXCEEDED AT {}{}", within->value.text,
                       exceeded->value.text, name);
  if (exceeded) return fmt::format("EXCEEDED AT {}{}", exceeded->value.text, name);
  if (!within && margin.whole.empty)
    return fmt::format("NO POSE REMAINS UP TO {}", margin.whole.empty->value.text);
  if (!within) return fmt::format("NOTHING KNOWN FROM {} ON", question.low.text);
  const bool all = question.high && within->value.approx == question.high->approx;
  return fmt::format("WITHIN UP TO {}{}", within->value.text, all ? "" : ", NOTHING KNOWN ABOVE");
}

std::string limit_margin_report(const Request& request, const MarginQuestion& question,
                                const LimitMargin& margin, const LimitMarginSettings& settings) {
  std::string text =
      fmt::format("model      {}\nmotion     {}\nmargin     {}, from {} to {}\nlimit      {}\n",
                  request.model.name, request.motion.name, describe_quantity(question),
                  question.low.text, question.high ? question.high->text : "where it ends",
                  describe_limit(margin.quantity, settings.limit));
  text += fmt::format("boxes      {} evaluated\n", margin.whole.boxes);
  text += format_time(seconds_of(margin));
  if (const ComponentMargin* c = exceeding(margin); c && c->exceeded)
    text += fmt::format("exceeded   {}{}\n{}",
                        c->component.label.empty() ? "" : c->component.label + ": ",
                        c->exceeded->pose, c->exceeded->values);
  if (margin.whole.gap)
    text += fmt::format("gap        {:.3g} % of the upper end\n", 100 * *margin.whole.gap);
  for (const ComponentMargin& c : margin.components) text += c.proofs.lines();
  return text;
}

Json json_limit_margin(const Request& request, const MarginQuestion& question,
                       const LimitMargin& margin, const LimitMarginSettings& settings) {
  Json report = json_bracket(question, margin.whole, settings.gap);
  report["limit"] = describe_limit(margin.quantity, settings.limit);
  report["limit_exact"] = formula_text(settings.limit);
  report["quantity"] = json_quantity(request.model, margin.quantity);
  report["bracket"] = describe_limit_bracket(question, margin);
  report["model"] = request.model.name;
  report["model_file"] = request.model.path;
  report["model_sha256"] = request.model.sha256;
  report["motion"] = request.motion.name;
  if (request.motion.trajectory) report["waypoints"] = json_waypoints(*request.motion.trajectory);
  report["components"] = Json::array();
  for (const ComponentMargin& c : margin.components)
    report["components"].push_back(json_component(c));
  report["boxes"] = margin.whole.boxes;
  report["question"] = json_question(request, settings.search);
  report["seconds"] = json_seconds(seconds_of(margin));
  return report;
}

}  // namespace regulus
