// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/check.hpp"

#include <nlohmann/json.hpp>

#include "codegen/api/algebra_lock.hpp"
#include "codegen/api/proof_fields.hpp"
#include "codegen/certificate/certificate_file.hpp"
#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/report/report.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/trajectory/read_trajectory.hpp"
#include "codegen/trajectory/trajectory_certificate.hpp"
#include "codegen/trajectory/trajectory_report.hpp"
#include "runtime/certificate/format.hpp"

namespace regulus::inline api {
namespace {

using Json = nlohmann::ordered_json;

Finding check_along_waypoints(Request request, double model_seconds, const SearchOptions& search,
                              const std::atomic<bool>* interrupt, const std::string& path) {
  const TrajectoryCheck check =
      check_trajectory(std::move(request), model_seconds, search, !path.empty(), interrupt);
  const ProofStatus certificate = certify_trajectory(path, check);
  Finding finding;
  finding.verdict = check.verdict;
  if (check.deciding) finding.result = check.deciding->result;
  finding.result.verdict = check.verdict;
  finding.result.reason = check.reason;
  finding.result.statistics = check.path.statistics;
  finding.report = format_trajectory(check, search);
  Json report = json_trajectory(check, search);
  finding.claim = report["claim"];
  add_proof(certificate, std::move(report), finding);
  return finding;
}

/// Returns nullopt unless the motion is along way-points.
std::optional<Finding> check_if_along_waypoints(const ModelOptions& model,
                                                const SearchOptions& search,
                                                const std::atomic<bool>* interrupt,
                                                const std::string& certificate) {
  Stopwatch watch;
  std::optional<Request> request = read_trajectory(model);
  if (!request) return std::nullopt;
  return check_along_waypoints(std::move(*request), watch.lap(), search, interrupt, certificate);
}

Finding check_variety(const ModelOptions& model, const SearchOptions& search,
                      const std::atomic<bool>* interrupt, const std::string& path) {
  PreparedSearch prepared = prepare(model, search, FormingWatch{.interrupt = interrupt});
  CertificateFile certificate(path, prepared);
  Finding finding;
  finding.result = run_search(prepared, search, settings_of(prepared, search, interrupt),
                              certificate.observer());
  certificate.finish(finding.result);
  const auto nearest = nearest_singular(prepared, finding.result);
  finding.verdict = finding.result.verdict;
  finding.claim = claim(prepared, finding.result);
  finding.report = text_report(prepared, search, finding.result, nearest);
  for (const VariableLabel& variable : prepared.labels.variables)
    finding.variables.push_back(variable.name);
  add_proof(certificate.status(), json_report(prepared, search, finding.result, nearest), finding);
  return finding;
}

}  // namespace

Finding check(const Question& question, const SearchOptions& options,
              const std::atomic<bool>* interrupt, const std::string& certificate) {
  const AlgebraLock lock;
  Stopwatch watch;
  const ModelOptions& model = question.options();
  set_earlier_outputs_aside({model.path, model.waypoints},
                            {{"certificate", certificate, true, format::kShardsEnding}});
  std::optional<Finding> finding = check_if_along_waypoints(model, options, interrupt, certificate);
  if (!finding) finding = check_variety(model, options, interrupt, certificate);
  finding->seconds = watch.lap();
  return std::move(*finding);
}

}  // namespace regulus::api
