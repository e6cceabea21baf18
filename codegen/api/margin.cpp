// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/margin.hpp"

#include <nlohmann/json.hpp>

#include "codegen/api/algebra_lock.hpp"
#include "codegen/api/proof_fields.hpp"
#include "codegen/bound/bound_question.hpp"
#include "codegen/bound/bound_run.hpp"
#include "codegen/bound/limit_margin.hpp"
#include "codegen/margin/margin_report.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/margin/variety_attempts.hpp"
#include "codegen/report/output_options.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/trajectory/trajectory_margin.hpp"

namespace regulus::inline api {
namespace {

constexpr OutputOptions kQuiet{.json = false, .quiet = true};

std::optional<std::string> text_of(const std::optional<MarginStep>& step) {
  return step ? std::optional(step->value.text) : std::nullopt;
}

MarginFinding margin_of_limit(ModelOptions model, const MarginOptions& options,
                              const MarginQuestion& question, LimitMarginSettings settings) {
  if (options.limit.empty() || options.quantity.quantity.empty())
    throw UsageError("margin: quantity and limit need each other");
  const std::string path = model.path;
  const Request request = read_asked(std::move(model), options.quantity);
  Quantity quantity = quantity_of(request.model, options.quantity);
  set_earlier_outputs_aside({path}, certificate_files(quantity, options.certificate));
  settings.limit = read_limit(options.limit, quantity);
  const LimitMargin found = limit_margin(request, question, std::move(quantity), settings, nullptr);
  MarginFinding finding;
  finding.safe = text_of(found.whole.certified);
  finding.exceeded = text_of(found.whole.refuted);
  finding.closed = found.whole.closed;
  finding.bracket = describe_limit_bracket(question, found);
  finding.report = limit_margin_report(request, question, found, settings);
  finding.json = report_text(json_limit_margin(request, question, found, settings), 2);
  for (const ComponentMargin& c : found.components) add_ends(c.proofs, c.component.label, finding);
  return finding;
}

MarginFinding finding_of(const MarginQuestion& question, const Margin& found) {
  MarginFinding finding;
  finding.safe = text_of(found.certified);
  finding.singular = text_of(found.refuted);
  finding.closed = found.closed;
  finding.bracket = describe_bracket(question, found);
  return finding;
}

MarginFinding margin_along_waypoints(Request request, const MarginQuestion& question,
                                     const MarginOptions& options,
                                     const std::atomic<bool>* interrupt) {
  const double gap = read_gap(options.gap);
  const MarginRequest growing(std::move(request), question);
  const TrajectoryMargin found =
      margin_of_trajectory(growing, question, options.search, gap, {.interrupt = interrupt},
                           margin_proofs(options.certificate, nullptr));
  MarginFinding finding = finding_of(question, found.margin);
  finding.report = format_trajectory_margin(found, question, options.search);
  finding.json = report_text(json_trajectory_margin(found, question, options.search, gap), 2);
  add_ends(found.proofs, "", finding);
  return finding;
}

MarginFinding margin_of_regularity(Request request, const MarginQuestion& question,
                                   const MarginOptions& options,
                                   const std::atomic<bool>* interrupt) {
  const double gap = read_gap(options.gap);
  PreparedMargin margin(question, std::move(request), 0, compiled_first(options.search),
                        FormingWatch{.interrupt = interrupt});
  margin.settings.interrupt = interrupt;
  VarietyAttempts attempts(margin, question, kQuiet, margin_proofs(options.certificate, nullptr));
  const Margin found = close_bracket(
      attempts, question, {.limits = limits_of(margin.settings, gap), .interrupt = interrupt});
  margin.prepared.seconds.search = found.seconds;
  MarginFinding finding = finding_of(question, found);
  const EndProofs& proofs = attempts.proofs();
  finding.report = margin_report(margin.prepared, margin.search, question, found) + proofs.lines();
  nlohmann::ordered_json report =
      json_margin(margin.prepared, margin.search, margin.request.nominal(), question, found, gap);
  proofs.add_to(report);
  finding.json = report_text(report, 2);
  add_ends(proofs, "", finding);
  return finding;
}

}  // namespace

MarginFinding margin(const Question& asked, const MarginOptions& options,
                     const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  ModelOptions model = asked.options();
  if (!options.tolerance.empty()) model.tolerances.push_back(options.tolerance);
  if (!options.alpha.empty()) model.alpha = options.alpha;
  const double gap = read_gap(options.gap);
  const MarginQuestion question = take_question(model, {options.scale, options.parameter});
  if (!options.limit.empty() || !options.quantity.quantity.empty()) {
    LimitMarginSettings settings;
    settings.gap = gap;
    settings.search = options.search;
    settings.output = kQuiet;
    settings.certificate = options.certificate;
    settings.interrupt = interrupt;
    return margin_of_limit(std::move(model), options, question, std::move(settings));
  }
  Request request = read_request(model);
  set_earlier_outputs_aside({model.path, model.waypoints}, EndProofs::files(options.certificate));
  if (request.motion.trajectory)
    return margin_along_waypoints(std::move(request), question, options, interrupt);
  return margin_of_regularity(std::move(request), question, options, interrupt);
}

}  // namespace regulus::api
