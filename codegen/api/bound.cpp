// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/bound.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/api/algebra_lock.hpp"
#include "codegen/api/proof_fields.hpp"
#include "codegen/bound/bound_question.hpp"
#include "codegen/bound/bound_report.hpp"
#include "codegen/bound/bound_run.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/earlier_outputs.hpp"

namespace regulus::inline api {
namespace {

BoundVerdict verdict_of(const Bound& bound) {
  switch (bound.verdict()) {
    case LimitVerdict::kWithin:
      return BoundVerdict::kWithin;
    case LimitVerdict::kExceeded:
      return BoundVerdict::kExceeded;
    case LimitVerdict::kUndecided:
      break;
  }
  return BoundVerdict::kUndecided;
}

BoundFinding finding_of(const Request& request, const Bound& bound, const BoundSettings& settings) {
  const nlohmann::ordered_json report = json_bound(request, bound, settings);
  BoundFinding finding;
  if (settings.limit) {
    finding.verdict = verdict_of(bound);
  } else {
    if (report["attained"].is_number()) finding.attained = report["attained"];
    if (report["proved"].is_number()) finding.proved = report["proved"];
    finding.closed = bound.is_closed();
  }
  finding.unit = bound.quantity.unit;
  finding.result = describe_bound(bound, settings);
  finding.report = fmt::format("model      {}\nmotion     {}\nbound      {}\n", request.model.name,
                               request.motion.name, bound.quantity.name);
  for (const ComponentBound& component : bound.components)
    finding.report += format_component(component, settings.limit.has_value());
  finding.report += bound_report(request, bound, settings);
  finding.json = report_text(report, 2);
  for (const ComponentBound& component : bound.components)
    add_ends(component.proofs, component.component.label, finding);
  return finding;
}

}  // namespace

BoundFinding bound(const Question& asked, const BoundOptions& options,
                   const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  BoundQuestion question = read_bound_question(asked.options(), options.quantity, options.limit);
  BoundSettings settings;
  settings.gap = read_gap(options.gap);
  settings.limit = question.limit;
  settings.search = options.search;
  settings.output = {.json = false, .quiet = true};
  settings.interrupt = interrupt;
  settings.certificate = options.certificate;
  set_earlier_outputs_aside({asked.options().path, asked.options().waypoints},
                            certificate_files(question.quantity, options.certificate));
  const Bound bound = bound_quantity(question.request, std::move(question.quantity), settings,
                                     [](const ComponentBound&) {});
  return finding_of(question.request, bound, settings);
}

}  // namespace regulus::api
