// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/margin/margin_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report_parts.hpp"
#include "codegen/answer/report/witness_report.hpp"
#include "codegen/model/exact/decimal.hpp"
#include "codegen/question/engine/choices.hpp"

namespace regulus {
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
  object["low"] = question.low.text;
  object["high"] = question.high ? Json(question.high->text) : Json(nullptr);
  return object;
}

Json json_steps(const Margin& margin) {
  Json steps = Json::array();
  for (const MarginStep& step : margin.steps)
    steps.push_back({{"value", step.value.approx},
                     {"exact", step.value.text},
                     {"verdict", json_name(step.result.verdict)},
                     {"reason", describe(step.result.reason)},
                     {"nonempty", json_occupancy(step.result)},
                     {"boxes", step.result.statistics.boxes},
                     {"seconds", step.result.statistics.seconds}});
  return steps;
}

std::string reason_to_end(const Margin& margin) {
  if (margin.closed) return "the bracket is closed";
  if (margin.interrupted) return "the run was interrupted";
  return "no search between the ends was likely to end within the time left";
}

}  // namespace

std::string describe_bracket(const MarginQuestion& question, const Margin& margin) {
  const std::optional<MarginStep>& certified = margin.certified;
  const std::optional<MarginStep>& refuted = margin.refuted;
  if (certified && refuted)
    return fmt::format("SAFE UP TO {}, NOT AT {}", certified->value.text, refuted->value.text);
  if (refuted) return fmt::format("NOT SAFE AT {}", refuted->value.text);
  if (!certified && margin.empty)
    return fmt::format("NO POSE REMAINS UP TO {}", margin.empty->value.text);
  if (!certified) return fmt::format("NOTHING KNOWN FROM {} ON", question.low.text);
  const bool all = question.high && certified->value.approx == question.high->approx;
  return fmt::format("SAFE UP TO {}{}", certified->value.text, all ? "" : ", NOTHING KNOWN ABOVE");
}

std::string format_step(const MarginStep& step) {
  const Result& result = step.result;
  std::string line =
      fmt::format("{:<10} {:<16} {:>9} boxes {:>8.2f} s", step.value.text, name(result.verdict),
                  result.statistics.boxes, result.statistics.seconds);
  if (result.verdict == Verdict::kPossibleProblem)
    line += fmt::format("   {}", describe(result.reason));
  if (result.verdict == Verdict::kSingularity && result.statistics.boxes == 0)
    line += "   a witness found beforehand";
  return line + "\n";
}

std::string margin_report(const PreparedSearch& p, const SearchOptions& search,
                          const MarginQuestion& question, const Margin& margin) {
  std::string text =
      fmt::format("model      {}\nmotion     {}\nmargin     {}, from {} to {}\n", p.labels.model,
                  p.labels.motion, describe_quantity(question), question.low.text,
                  question.high ? question.high->text : "where it ends");
  text += format_method(p, search, search.method, margin.boxes);
  text += fmt::format("boxes      {} evaluated at {} values\n", margin.boxes, margin.steps.size());
  text += format_time(p.seconds_spent());
  if (margin.empty)
    text += fmt::format("at {}: {}\n", margin.empty->value.text, margin.empty->claim);
  if (margin.certified)
    text += fmt::format("at {}: {}\n", margin.certified->value.text, margin.certified->claim) +
            format_occupancy(margin.certified->result);
  if (margin.refuted)
    text += fmt::format("at {}: {}\n", margin.refuted->value.text, margin.refuted->claim) +
            format_witness(p, margin.refuted->result);
  if (margin.gap) text += fmt::format("gap        {:.3g} % of the upper end\n", 100 * *margin.gap);
  return text + fmt::format("ended      {}\n", reason_to_end(margin));
}

Json json_bracket(const MarginQuestion& question, const Margin& margin, double gap_wanted) {
  Json report;
  report["margin"] = json_question(question);
  report["bracket"] = describe_bracket(question, margin);
  report["certified"] = json_value(margin.certified, false);
  report["certified_exact"] = json_text(margin.certified);
  report["certified_claim"] = margin.certified ? Json(margin.certified->claim) : Json(nullptr);
  report["nonempty"] = margin.refuted     ? Json(true)
                       : margin.certified ? json_occupancy(margin.certified->result)
                       : margin.empty     ? Json(false)
                                          : Json(nullptr);
  report["refuted"] = json_value(margin.refuted, true);
  report["refuted_exact"] = json_text(margin.refuted);
  report["refuted_claim"] = margin.refuted ? Json(margin.refuted->claim) : Json(nullptr);
  report["gap"] = margin.gap ? Json(*margin.gap) : Json(nullptr);
  report["gap_wanted"] = gap_wanted;
  report["closed"] = margin.closed;
  report["reason"] = reason_to_end(margin);
  return report;
}

Json json_margin(const PreparedSearch& p, const SearchOptions& search, const Request& nominal,
                 const MarginQuestion& question, const Margin& margin, double gap_wanted) {
  Json report = json_bracket(question, margin, gap_wanted);
  report["model"] = p.labels.model;
  report["model_file"] = p.model_file;
  report["model_sha256"] = p.labels.model_sha256;
  report["motion"] = p.labels.motion;
  report["method"] = name(search.method);
  report["without"] = search.without;
  report["forms"] = json_forms(p);
  report["witness"] = margin.refuted ? json_witness(p, margin.refuted->result) : Json(nullptr);
  report["boxes"] = margin.boxes;
  report["steps"] = json_steps(margin);
  report["bits"] = p.bits;
  report["question"] = json_question(nominal, search);
  report["engine"] = word_of(search.engine);
  report["isa"] = name(p.isa);
  report["cache"] = p.cache;
  report["seconds"] = json_seconds(p.seconds_spent());
  return report;
}

}  // namespace regulus
