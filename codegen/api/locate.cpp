// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/locate.hpp"

#include <nlohmann/json.hpp>

#include "codegen/api/algebra_lock.hpp"
#include "codegen/engine/paving_verdict.hpp"
#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/report/paving_options.hpp"
#include "codegen/report/paving_report.hpp"
#include "codegen/report/report_text.hpp"
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

}  // namespace

Paving locate(const Question& question, const LocateOptions& options,
              const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  const SearchOptions& search = options.search;
  ModelOptions model = question.options();
  model.separates_reach = true;
  PreparedSearch prepared = prepare(model, search, FormingWatch{.interrupt = interrupt});
  const PavingOptions paving = resolve_paving(options.resolution, search, prepared);
  const Problem problem = prepared.problem();
  Volumes volumes(problem, prepared.labels.reach);
  BoxListener listener(options, interrupt, problem, prepared.labels.reach);
  Observers observers({&volumes, &listener});
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
  found.verdict = found.result.verdict;
  found.free = volumes.fraction(volumes.of(Claim::kFree));
  found.singular = volumes.fraction(volumes.of(Claim::kSingular));
  found.undecided = volumes.fraction(volumes.of(Claim::kUndecided));
  found.outside = volumes.fraction(volumes.of(Claim::kOutside));
  found.unreachable = volumes.fraction(volumes.of(Claim::kUnreachable));
  found.report = paving_report(prepared, search, paving, volumes, found.result);
  found.json = report_text(json_paving_summary(prepared, search, paving, volumes, found.result), 2);
  for (const VariableLabel& variable : prepared.labels.variables)
    found.variables.push_back(variable.name);
  return found;
}

}  // namespace regulus::api
