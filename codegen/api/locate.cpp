// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/locate.hpp"

#include <nlohmann/json.hpp>

#include "codegen/api/algebra_lock.hpp"
#include "codegen/api/proof_fields.hpp"
#include "codegen/certificate/certificate_file.hpp"
#include "codegen/engine/paving_verdict.hpp"
#include "codegen/engine/refusals.hpp"
#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/report/paving_options.hpp"
#include "codegen/report/paving_report.hpp"
#include "codegen/report/report_text.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/trajectory/read_trajectory.hpp"
#include "codegen/trajectory/trajectory_paving.hpp"
#include "runtime/certificate/format.hpp"
#include "runtime/problem/observers.hpp"
#include "runtime/search/leaf_claims.hpp"
#include "runtime/search/workspace.hpp"

namespace regulus::inline api {
namespace {

/// Passes the boxes to the callback. An exception from a callback ends the search, and locate()
/// throws it again.
class BoxListener final : public Observer {
 public:
  explicit BoxListener(const LocateOptions& options, const std::atomic<bool>* interrupt,
                       const Problem& problem, std::size_t reach)
      : options_(options), interrupt_(interrupt), claims_(problem, reach) {}

  void on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept override {
    tell(claims_.of(box.box, rule), box.box);
  }
  void on_open(const OpenBox& box) noexcept override { tell(Claim::kUndecided, box.box); }
  void on_progress(const Statistics&, std::uint64_t) noexcept override {
    if (interrupt_ != nullptr && *interrupt_) stop_ = true;
  }

  [[nodiscard]] const std::atomic<bool>& stop() const noexcept { return stop_; }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void tell(Claim claim, std::span<const Interval> box) noexcept {
    if (!options_.on_box || thrown_) return;
    try {
      options_.on_box(claim, box);
    } catch (...) {
      thrown_ = std::current_exception();
      stop_ = true;
    }
  }

  const LocateOptions& options_;
  const std::atomic<bool>* interrupt_;
  LeafClaims claims_;
  std::atomic<bool> stop_{false};
  std::exception_ptr thrown_;
};

void set_fractions(const Volumes& volumes, Paving& found) {
  const auto fraction = [&volumes](Claim claim) { return volumes.fraction(volumes.of(claim)); };
  found.free = fraction(Claim::kFree);
  found.singular = fraction(Claim::kSingular);
  found.undecided = fraction(Claim::kUndecided);
  found.outside = fraction(Claim::kOutside);
  found.unreachable = fraction(Claim::kUnreachable);
}

Paving pave_variety(const Question& question, const LocateOptions& options,
                    const std::atomic<bool>* interrupt) {
  const SearchOptions& search = options.search;
  ModelOptions model = question.options();
  // A certificate is about all poses of the motion.
  model.separates_reach = options.certificate.empty();
  PreparedSearch prepared = prepare(model, search, FormingWatch{.interrupt = interrupt});
  const PavingOptions paving = resolve_paving(options.resolution, search, prepared);
  const Problem problem = prepared.problem();
  Volumes volumes(problem, prepared.labels.reach);
  BoxListener listener(options, interrupt, problem, prepared.labels.reach);
  CertificateFile certificate(options.certificate, prepared);
  std::vector<Observer*> watching = {&volumes, &listener};
  if (certificate.observer() != nullptr) watching.push_back(certificate.observer());
  Observers observers(std::move(watching));
  Settings settings = settings_of(prepared, search, &listener.stop());
  require_paving(paving, settings);
  Paving found;
  found.result = run_search(prepared, search, settings, &observers);
  listener.rethrow();
  close_in_on_witness(prepared, search, settings, found.result);
  if (problem.kernel->constraints > 0) {
    volumes.set_workspace(measure_workspace(problem, volumes, paving.resolution, listener.stop()));
    found.workspace = volumes.workspace_fraction();
  }
  keep_poses_out_of_reach(prepared, volumes, found.result);
  certificate.finish(found.result);
  found.verdict = found.result.verdict;
  set_fractions(volumes, found);
  found.report = paving_report(prepared, search, paving, volumes, found.result);
  add_proof(certificate.status(),
            json_paving_summary(prepared, search, paving, volumes, found.result), found);
  for (const VariableLabel& variable : prepared.labels.variables)
    found.variables.push_back(variable.name);
  return found;
}

Paving pave_path(Request request, double model_seconds, const LocateOptions& options,
                 const std::atomic<bool>* interrupt) {
  const PathPaving paving = pave_trajectory(
      std::move(request), model_seconds, options.search,
      options.resolution.empty() ? kPathResolution : read_resolution(options.resolution),
      interrupt);
  Paving found;
  found.verdict = found.result.verdict = paving.check.verdict;
  found.result.reason = paving.check.reason;
  found.result.statistics = paving.check.path.statistics;
  for (Interval* fraction :
       {&found.free, &found.singular, &found.undecided, &found.outside, &found.unreachable})
    *fraction = {0, 1};
  for (const PathStretch& stretch : paving.stretches)
    found.stretches.push_back({stretch.claim, stretch.begin.piece + 1, stretch.end.piece + 1,
                               stretch.begin.s, stretch.end.s,
                               report_text(json_stretch(paving, stretch))});
  found.report = format_path_paving(paving, options.search);
  found.json = report_text(json_path_paving(paving, options.search), 2);
  return found;
}

}  // namespace

Paving locate(const Question& question, const LocateOptions& options,
              const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  Stopwatch watch;
  ModelOptions model = question.options();
  model.separates_reach = true;
  std::optional<Request> along = read_trajectory(model);
  if (!along) {
    set_earlier_outputs_aside({model.path, model.waypoints},
                              {{"certificate", options.certificate, true, format::kShardsEnding}});
    return pave_variety(question, options, interrupt);
  }
  refuse(Asked::kPathPaving, "certificate", !options.certificate.empty());
  return pave_path(std::move(*along), watch.lap(), options, interrupt);
}

}  // namespace regulus::api
