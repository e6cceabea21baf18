// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/margin.hpp"

#include <nlohmann/json.hpp>

#include "codegen/api/algebra_lock.hpp"
#include "codegen/margin/margin_report.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/report/output_options.hpp"

namespace regulus::inline api {

MarginFinding margin(const Question& asked, const MarginOptions& options,
                     const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  ModelOptions model = asked.options();
  if (!options.tolerance.empty()) model.tolerances.push_back(options.tolerance);
  if (!options.alpha.empty()) model.alpha = options.alpha;
  const double gap = read_gap(options.gap);
  const MarginQuestion question = take_question(model, {options.scale, options.parameter});
  PreparedMargin margin(question, model, options.search, FormingWatch{.interrupt = interrupt});
  margin.settings.interrupt = interrupt;
  MarginCertificates none({}, margin.request, margin.prepared.labels);
  const OutputOptions quiet{.json = false, .quiet = true};
  const Margin found = MarginRun(margin.prepared, question, margin.request, margin.search, quiet,
                                 margin.settings, gap, none, [](const MarginStep&) {})
                           .run();
  margin.prepared.seconds.search = found.seconds;
  MarginFinding finding;
  if (found.certified) finding.safe = found.certified->value.text;
  if (found.refuted) finding.singular = found.refuted->value.text;
  finding.closed = found.closed;
  finding.bracket = describe_bracket(question, found);
  finding.report = margin_report(margin.prepared, margin.search, question, found);
  finding.json = json_margin(margin.prepared, margin.search, question, found, gap).dump(2);
  return finding;
}

}  // namespace regulus::api
