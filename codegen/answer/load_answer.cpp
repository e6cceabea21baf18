// SPDX-License-Identifier: GPL-3.0-or-later
// Do forces within the limits hold a load, and where?
#include <nlohmann/json.hpp>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/lines_file.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/refusals.hpp"
#include "codegen/answer/report/paving_options.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/question/load/feasibility_report.hpp"
#include "codegen/question/load/force_certificate.hpp"
#include "codegen/question/load/way_force_paving.hpp"
#include "codegen/question/way/read_trajectory.hpp"
#include "codegen/support/stopwatch.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

/// A search with its certificate, of a whole motion or of a paving.
class LoadSearch {
 public:
  LoadSearch(const ModelOptions& model, const SearchOptions& search, const std::string& load,
             bool paves, const Services& services)
      : prepared_(prepare_forces(model, load, search, watch_of(services))),
        certificate_(services.certificate, prepared_, paves) {}

  /// An exception from the listener ends the search.
  void run(const FeasibilitySettings& settings, const ForceListener& listener,
           const Services& services) {
    ForceCheckpoint checkpoint(services.checkpoint, prepared_, settings);
    SearchDisplay display(display_of(services));
    Observers observers(present({certificate_.observer(), display.observer()}));
    result_ = run_forces(prepared_, settings, listener, &observers, &checkpoint);
    certificate_.finish(result_);
    checkpoint_line_ = checkpoint.line();
  }

  void describe(LoadAnswer& answer) const {
    answer.verdict = result_.verdict;
    answer.boxes = result_.boxes;
    answer.proof = certificate_.status();
    if (answer.proof.is_lost()) answer.lost.push_back(answer.proof.obstacle());
    for (const VariableLabel& variable : prepared_.preparation.labels.variables)
      answer.variables.push_back(variable.name);
    if (answer.verdict == FeasibilityVerdict::kFeasible) answer.claim = describe_claim(prepared_);
    if (answer.verdict == FeasibilityVerdict::kPossibleProblem)
      answer.reason = describe_reason(prepared_, result_);
  }
  /// `volumes`: of a paving, or null.
  void tell(const ForceVolumes* volumes, Facts& facts) const {
    tell_forces(prepared_, result_, volumes, facts);
    certificate_.status().tell(facts);
  }

  [[nodiscard]] PreparedForces& prepared() { return prepared_; }
  [[nodiscard]] const FeasibilityResult& result() const { return result_; }
  [[nodiscard]] std::string about_files() const {
    return certificate_.status().line() + checkpoint_line_;
  }

 private:
  PreparedForces prepared_;
  ForceCertificate certificate_;
  FeasibilityResult result_;
  std::string checkpoint_line_;
};

class VarietyLoad final : public LoadAnswer {
 public:
  VarietyLoad(const AskLoad& asked, const Services& services)
      : search_(asked.model, asked.search, asked.load, false, services) {
    services.begin_search();
    search_.run(
        settings_of(search_.prepared(), services.interrupt),
        [](std::span<const Interval>, ForceClaim) {}, services);
    search_.describe(*this);
  }

  void tell(Facts& facts) const override { search_.tell(nullptr, facts); }
  [[nodiscard]] std::string about_files() const override { return search_.about_files(); }

 private:
  LoadSearch search_;
};

/// The answer for a motion along way-points has no `variables`.
class WayLoad final : public LoadAnswer {
 public:
  WayLoad(Request request, double model_seconds, const AskLoad& asked, const Services& services) {
    SearchDisplay display(display_of(services));
    found_ = check_forces_along_way(std::move(request), model_seconds, asked.load, asked.search,
                                    !services.certificate.empty(),
                                    {services.interrupt, display.observer()});
    verdict = found_.verdict;
    boxes = found_.boxes;
    proof = certify_way_forces(services.certificate, found_);
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    if (verdict == FeasibilityVerdict::kFeasible) claim = describe_claim(found_);
    if (verdict == FeasibilityVerdict::kPossibleProblem) reason = describe_reason(found_);
  }

  void tell(Facts& facts) const override {
    tell_way_forces(found_, facts);
    proof.tell(facts);
  }

 private:
  WayForces found_;
};

class VarietyLoadPaving final : public LoadPavingAnswer {
 public:
  VarietyLoadPaving(const AskLoadPaving& asked, const Services& services)
      : search_(asked.model, asked.search, asked.load, true, services),
        volumes_(search_.prepared().problem) {
    const PreparedForces& prepared = search_.prepared();
    resolution_ = resolve_paving(asked.resolution, asked.search, prepared.preparation).resolution;
    LinesFile lines(services.lines);
    const auto write = [&](const Json& line) {
      if (!lines.is_wanted()) return;
      // A line that cannot be written ends the search, with the reason that the file has.
      if (!(lines.stream() << report_text(line) << '\n')) lines.finish();
    };
    write(json_forces_header(prepared, resolution_));
    pave(services, [&](std::span<const Interval> box, ForceClaim held) {
      volumes_.add(box, held);
      write(json_forces_box(prepared, box, held));
      if (services.on_force_box) services.on_force_box(held, box);
    });
    write_beside([&] {
      write(json());
      lines.finish();
    });
  }

  void tell(Facts& facts) const override { search_.tell(&volumes_, facts); }
  [[nodiscard]] std::string about_files() const override { return search_.about_files(); }

 private:
  void pave(const Services& services, const ForceListener& listener) {
    FeasibilitySettings settings = settings_of(search_.prepared(), services.interrupt);
    settings.paves = true;
    settings.min_relative_width = resolution_;
    services.begin_search();
    search_.run(settings, listener, services);
    search_.describe(*this);
    feasible = volumes_.fraction(ForceClaim::kFeasible);
    infeasible = volumes_.fraction(ForceClaim::kInfeasible);
    undecided = volumes_.fraction(ForceClaim::kUndecided);
    outside = volumes_.fraction(ForceClaim::kOutside);
  }

  LoadSearch search_;
  ForceVolumes volumes_;
  double resolution_ = 1;
};

/// Of a motion along way-points: stretches, and no boxes.
class WayLoadPaving final : public LoadPavingAnswer {
 public:
  WayLoadPaving(Request request, double model_seconds, const AskLoadPaving& asked,
                const Services& services)
      : lines_(services.lines) {
    SearchDisplay display(display_of(services));
    paving_ = pave_forces_along_way(
        std::move(request), model_seconds, asked.load, asked.search,
        asked.resolution.empty() ? kPathResolution : read_resolution(asked.resolution),
        {services.interrupt, display.observer()});
    verdict = paving_.found.verdict;
    boxes = paving_.found.boxes;
    if (verdict == FeasibilityVerdict::kFeasible) claim = describe_claim(paving_.found);
    if (verdict == FeasibilityVerdict::kPossibleProblem) reason = describe_reason(paving_.found);
    write_beside([this] { write(); });
  }

  void tell(Facts& facts) const override { tell_way_force_paving(paving_, facts); }

 private:
  void write() {
    if (!lines_.is_wanted()) return;
    for (const ForceStretch& stretch : paving_.stretches)
      lines_.stream() << report_text(json_force_stretch(paving_, stretch)) << '\n';
    lines_.stream() << report_text({{"summary", json()}}) << '\n';
    lines_.finish();
  }

  LinesFile lines_;
  WayForcePaving paving_;
};

}  // namespace

std::unique_ptr<LoadAnswer> ask(const AskLoad& asked, const Services& services) {
  refuse_changed_options(asked.model, asked.search);
  refuse_services(Kind::kLoad, asked.search, services);
  refuse_services_along_way(Kind::kWayLoad, asked.model, asked.search, services);
  set_outputs_aside(asked.model, asked.search, services);
  Stopwatch watch;
  std::optional<Request> along = read_trajectory(asked.model, watch_of(services, asked.search));
  if (!along) return std::make_unique<VarietyLoad>(asked, services);
  services.begin_search();
  return std::make_unique<WayLoad>(std::move(*along), watch.lap(), asked, services);
}

std::unique_ptr<LoadPavingAnswer> ask(const AskLoadPaving& asked, const Services& services) {
  refuse_changed_options(asked.model, asked.search);
  refuse_services(Kind::kLoadPaving, asked.search, services);
  refuse_services_along_way(Kind::kWayLoadPaving, asked.model, asked.search, services);
  set_outputs_aside(asked.model, asked.search, services);
  Stopwatch watch;
  std::optional<Request> along = read_trajectory(asked.model, watch_of(services, asked.search));
  if (!along) return std::make_unique<VarietyLoadPaving>(asked, services);
  services.begin_search();
  return std::make_unique<WayLoadPaving>(std::move(*along), watch.lap(), asked, services);
}

}  // namespace regulus
