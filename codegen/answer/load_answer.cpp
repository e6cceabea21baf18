// SPDX-License-Identifier: GPL-3.0-or-later
// Do forces within the limits hold a load, and where?
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/closure_answer.hpp"
#include "codegen/answer/lines_file.hpp"
#include "codegen/answer/load_stretches.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/picture/pictures.hpp"
#include "codegen/answer/picture/way_picture.hpp"
#include "codegen/answer/refusals.hpp"
#include "codegen/answer/refused_paving.hpp"
#include "codegen/answer/report/paving_options.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/load/feasibility_report.hpp"
#include "codegen/question/load/force_certificate.hpp"
#include "codegen/question/load/way_force_paving.hpp"
#include "codegen/question/way/read_trajectory.hpp"
#include "codegen/support/stopwatch.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// A search with its certificate, of a whole motion or of a paving.
class LoadSearch {
 public:
  LoadSearch(const ModelOptions& model, const SearchOptions& search, const std::string& load,
             bool paves, const Services& services)
      : prepared_(prepare_forces(model, load, search, watch_of(services))),
        certificate_(services.certificate, prepared_, paves, services.shard_size) {}

  /// An exception from the listener ends the search.
  void run(const FeasibilitySettings& settings, const ForceListener& listener,
           const Services& services, const std::vector<Observer*>& pictures = {}) {
    SearchCheckpoint checkpoint(services.checkpoint,
                                [&] { return checkpointed_question(prepared_, settings); });
    SearchDisplay display(display_of(services));
    std::vector<Observer*> watching = present({certificate_.observer(), display.observer()});
    watching.insert(watching.end(), pictures.begin(), pictures.end());
    Observers observers(std::move(watching));
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
    SearchCheckpoint checkpoint(
        services.checkpoint,
        [&] { return checkpointed_question(request, asked.search, asked.load); }, true);
    found_ = check_forces_along_way(std::move(request), model_seconds, asked.load, asked.search,
                                    !services.certificate.empty(),
                                    {services.interrupt, display.observer(), &checkpoint});
    verdict = found_.verdict;
    boxes = found_.boxes;
    proof = certify_way_forces(services.certificate, found_, {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    write_beside([&] {
      checkpoint.finish(found_.can_continue && verdict == FeasibilityVerdict::kPossibleProblem);
    });
    checkpoint_line_ = checkpoint.line();
    if (verdict == FeasibilityVerdict::kFeasible) claim = describe_claim(found_);
    if (verdict == FeasibilityVerdict::kPossibleProblem) reason = describe_reason(found_);
  }

  void tell(Facts& facts) const override {
    tell_way_forces(found_, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  WayForces found_;
  std::string checkpoint_line_;
};

class VarietyLoadPaving final : public LoadPavingAnswer {
 public:
  VarietyLoadPaving(const AskLoadPaving& asked, const Services& services)
      : search_(asked.model, asked.search, asked.load, true, services),
        volumes_(search_.prepared().problem) {
    const PreparedForces& prepared = search_.prepared();
    PavingOptions options = resolve_paving(asked.resolution, asked.search, prepared.preparation);
    options.encloses_determinants = false;
    resolution_ = options.resolution;
    Pictures pictures(services.pictures, options, prepared.preparation, word_of_stand_in,
                      ", load " + prepared.load);
    LinesFile lines(services.lines);
    const auto write = [&](const Json& line) {
      if (!lines.is_wanted()) return;
      // A line that cannot be written ends the search, with the reason that the file has.
      if (!(lines.stream() << report_text(line) << '\n')) lines.finish();
    };
    write(json_forces_header(prepared, resolution_));
    const auto listen = [&](std::span<const Interval> box, ForceClaim held) {
      volumes_.add(box, held);
      write(json_forces_box(prepared, box, held));
      if (services.on_force_box) services.on_force_box(held, box);
    };
    pave(services, listen, pictures.observers());
    write_beside([&] {
      write(json());
      lines.finish();
    });
    write_beside([&] { pictures.draw(volumes_.by_stand_in()); });
    map_ = pictures.map();
  }

  void tell(Facts& facts) const override {
    search_.tell(&volumes_, facts);
    facts.say("map", map_);
  }
  [[nodiscard]] std::string about_files() const override { return search_.about_files(); }

 private:
  void pave(const Services& services, const ForceListener& listener,
            const std::vector<Observer*>& pictures) {
    FeasibilitySettings settings = settings_of(search_.prepared(), services.interrupt);
    settings.paves = true;
    settings.min_relative_width = resolution_;
    services.begin_search();
    search_.run(settings, listener, services, pictures);
    search_.describe(*this);
    feasible = volumes_.fraction(ForceClaim::kFeasible);
    infeasible = volumes_.fraction(ForceClaim::kInfeasible);
    undecided = volumes_.fraction(ForceClaim::kUndecided);
    outside = volumes_.fraction(ForceClaim::kOutside);
  }

  LoadSearch search_;
  ForceVolumes volumes_;
  std::string map_;
  double resolution_ = 1;
};

/// Of a motion along way-points: stretches, and no boxes.
class WayLoadPaving final : public LoadPavingAnswer {
 public:
  WayLoadPaving(Request request, double model_seconds, const AskLoadPaving& asked,
                const Services& services)
      : lines_(services.lines) {
    WayPictures pictures(services.pictures);
    SearchDisplay display(display_of(services));
    const double resolution =
        asked.resolution.empty() ? kPathResolution : read_resolution(asked.resolution);
    SearchCheckpoint checkpoint(
        services.checkpoint,
        [&] {
          Json question = checkpointed_question(request, asked.search, asked.load);
          question["paves"] = true;
          question["resolution"] = resolution;
          return question;
        },
        true);
    paving_ = pave_forces_along_way(std::move(request), model_seconds, asked.load, asked.search,
                                    resolution, !services.certificate.empty(),
                                    {services.interrupt, display.observer(), &checkpoint});
    verdict = paving_.found.verdict;
    boxes = paving_.found.boxes;
    if (verdict == FeasibilityVerdict::kFeasible) claim = describe_claim(paving_.found);
    if (verdict == FeasibilityVerdict::kPossibleProblem) reason = describe_reason(paving_.found);
    proof = certify_way_forces(services.certificate, paving_.found, {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    const std::vector<PathStretch> parts = as_path_stretches(paving_);
    stretches = stretches_of_load(*paving_.found.request.motion.trajectory, parts);
    write_beside([&] { write_stretches(stretches, json(), lines_); });
    const Request& asked_about = paving_.found.request;
    write_beside([&] {
      pictures.draw({fmt::format("{}, {}, load {}", asked_about.model.name, asked_about.motion.name,
                                 asked.load),
                     *asked_about.motion.trajectory, parts, word_of_stand_in});
    });
    write_beside([&] { checkpoint.finish(paving_.found.can_continue); });
    checkpoint_line_ = checkpoint.line();
  }

  void tell(Facts& facts) const override {
    tell_way_force_paving(paving_, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  LinesFile lines_;
  WayForcePaving paving_;
  std::string checkpoint_line_;
};

}  // namespace

std::unique_ptr<LoadAnswer> ask(const AskLoad& asked, const Services& services) {
  refuse_changed_options(option_refusals_of_loads(), asked.model, asked.search, services.dashes);
  refuse_services(Kind::kLoad, asked.model, asked.search, services);
  set_outputs_aside(asked.model, asked.search, services);
  Stopwatch watch;
  std::optional<Request> along = read_trajectory(asked.model, watch_of(services, asked.search));
  if (!along) {
    std::optional<Request> closed = read_closure(asked.model, watch_of(services, asked.search));
    if (!closed) return std::make_unique<VarietyLoad>(asked, services);
    return answer_closure(std::move(*closed), watch.lap(), asked, services);
  }
  if (along->model.closure) return answer_closure(std::move(*along), watch.lap(), asked, services);
  services.begin_search();
  return std::make_unique<WayLoad>(std::move(*along), watch.lap(), asked, services);
}

std::unique_ptr<LoadPavingAnswer> ask(const AskLoadPaving& asked, const Services& services) {
  refuse_changed_options(option_refusals_of_loads(), asked.model, asked.search, services.dashes);
  refuse_services(Kind::kLoadPaving, asked.model, asked.search, services);
  refuse_paving(asked.resolution, asked.model, asked.search, services);
  set_outputs_aside(asked.model, asked.search, services);
  Stopwatch watch;
  std::optional<Request> along = read_trajectory(asked.model, watch_of(services, asked.search));
  if (!along) {
    std::optional<Request> closed = read_closure(asked.model, watch_of(services, asked.search));
    if (!closed) return std::make_unique<VarietyLoadPaving>(asked, services);
    return answer_closure(std::move(*closed), watch.lap(), asked, services);
  }
  if (along->model.closure)
    return answer_closure_way(std::move(*along), watch.lap(), asked, services);
  services.begin_search();
  return std::make_unique<WayLoadPaving>(std::move(*along), watch.lap(), asked, services);
}

}  // namespace regulus::detail
