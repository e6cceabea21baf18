// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/load.hpp"

#include <nlohmann/json.hpp>

#include "codegen/api/algebra_lock.hpp"
#include "codegen/api/proof_fields.hpp"
#include "codegen/engine/refusals.hpp"
#include "codegen/feasibility/feasibility_report.hpp"
#include "codegen/feasibility/force_certificate.hpp"
#include "codegen/feasibility/way_forces.hpp"
#include "codegen/report/paving_options.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/trajectory/read_trajectory.hpp"

namespace regulus::inline api {
namespace {

/// A prepared question with the certificate that its search writes.
class SearchOfLoad {
 public:
  SearchOfLoad(const Question& question, const std::string& load, const SearchOptions& search,
               const std::string& certificate, const std::atomic<bool>* interrupt, bool paves)
      : prepared_(
            prepare_forces(question.options(), load, search, FormingWatch{.interrupt = interrupt})),
        certificate_(certificate, prepared_, paves) {}

  [[nodiscard]] PreparedForces& prepared() { return prepared_; }

  /// An exception from the listener ends the search.
  FeasibilityResult run(const FeasibilitySettings& settings, const ForceListener& listener) {
    FeasibilityResult result = run_forces(prepared_, settings, listener, certificate_.observer());
    certificate_.finish(result);
    return result;
  }

  [[nodiscard]] LoadFinding finding(const FeasibilityResult& result, const ForceVolumes* volumes) {
    nlohmann::ordered_json report = json_forces(prepared_, result, volumes);
    LoadFinding finding;
    finding.verdict = result.verdict;
    if (report["claim"].is_string()) finding.claim = report["claim"];
    if (report["reason"].is_string()) finding.reason = report["reason"];
    finding.report = format_forces(prepared_, result, volumes);
    for (const VariableLabel& variable : prepared_.preparation.labels.variables)
      finding.variables.push_back(variable.name);
    finding.boxes = result.boxes;
    add_proof(certificate_.status(), std::move(report), finding);
    return finding;
  }

 private:
  PreparedForces prepared_;
  ForceCertificate certificate_;
};

/// Returns nullopt unless the motion is along way-points.
std::optional<LoadFinding> check_load_along_waypoints(const Question& question,
                                                      const std::string& load,
                                                      const SearchOptions& search,
                                                      const std::atomic<bool>* interrupt,
                                                      const std::string& certificate) {
  std::optional<Request> request = read_trajectory(question.options());
  if (!request) return std::nullopt;
  const WayForces found =
      check_forces_along_way(std::move(*request), 0, load, search, !certificate.empty(), interrupt);
  LoadFinding finding;
  nlohmann::ordered_json report = json_way_forces(found);
  finding.verdict = found.verdict;
  if (report["claim"].is_string()) finding.claim = report["claim"];
  if (report["reason"].is_string()) finding.reason = report["reason"];
  finding.report = format_way_forces(found);
  finding.boxes = found.boxes;
  add_proof(certify_way_forces(certificate, found), std::move(report), finding);
  return finding;
}

void set_aside(const Question& question, const std::string& certificate) {
  const ModelOptions& model = question.options();
  set_earlier_outputs_aside({model.path, model.waypoints}, {{"certificate", certificate, true}});
}

}  // namespace

LoadFinding check_load(const Question& question, const std::string& load,
                       const SearchOptions& options, const std::atomic<bool>* interrupt,
                       const std::string& certificate) {
  const AlgebraLock lock;
  Stopwatch watch;
  refuse_changed(Asked::kLoad, question.options(), options);
  set_aside(question, certificate);
  if (auto along = check_load_along_waypoints(question, load, options, interrupt, certificate)) {
    along->seconds = watch.lap();
    return std::move(*along);
  }
  SearchOfLoad search(question, load, options, certificate, interrupt, false);
  const FeasibilityResult result = search.run(settings_of(search.prepared(), interrupt),
                                              [](std::span<const Interval>, ForceClaim) {});
  LoadFinding finding = search.finding(result, nullptr);
  finding.seconds = watch.lap();
  return finding;
}

LoadPaving locate_load(const Question& question, const LocateLoadOptions& options,
                       const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  Stopwatch watch;
  refuse_changed(Asked::kLoad, question.options(), options.search);
  set_aside(question, options.certificate);
  SearchOfLoad search(question, options.load, options.search, options.certificate, interrupt, true);
  PreparedForces& prepared = search.prepared();
  const PavingOptions paving =
      resolve_paving(options.resolution, options.search, prepared.preparation);
  FeasibilitySettings settings = settings_of(prepared, interrupt);
  settings.paves = true;
  settings.min_relative_width = paving.resolution;
  ForceVolumes volumes(prepared.problem);
  const FeasibilityResult result =
      search.run(settings, [&](std::span<const Interval> box, ForceClaim claim) {
        volumes.add(box, claim);
        if (options.on_box) options.on_box(claim, box);
      });
  LoadPaving found{search.finding(result, &volumes), volumes.fraction(ForceClaim::kFeasible),
                   volumes.fraction(ForceClaim::kInfeasible),
                   volumes.fraction(ForceClaim::kUndecided),
                   volumes.fraction(ForceClaim::kOutside)};
  found.finding.seconds = watch.lap();
  return found;
}

}  // namespace regulus::api
