// SPDX-License-Identifier: GPL-3.0-or-later
// Do the motors of a closure hold a load within their limits, and where?
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/closure_answer.hpp"
#include "codegen/answer/lines_file.hpp"
#include "codegen/answer/load_stretches.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/picture/pictures.hpp"
#include "codegen/answer/picture/way_picture.hpp"
#include "codegen/answer/report/paving_options.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/question/closure/branch_load.hpp"
#include "codegen/question/closure/closure_way_paving.hpp"
#include "codegen/question/load/way_force_paving.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

void describe(const PreparedBranchLoad& prepared, const BranchLoadResult& result,
              LoadAnswer& answer) {
  answer.verdict = result.verdict;
  answer.boxes = result.boxes;
  answer.reason = result.reason;
  if (result.verdict == FeasibilityVerdict::kFeasible) answer.claim = claim_of(prepared);
  for (const VariableLabel& variable : prepared.closure().preparation.labels.variables)
    answer.variables.push_back(variable.name);
}

class ClosureLoad final : public LoadAnswer {
 public:
  ClosureLoad(Request request, double model_seconds, const AskLoad& asked, const Services& services)
      : prepared_(prepare_branch_load(std::move(request), model_seconds, asked.load, asked.search,
                                      watch_of(services, asked.search))) {
    SearchCheckpoint checkpoint(
        services.checkpoint, [&] { return checkpointed_question(prepared_, std::nullopt); },
        prepared_.branch.trajectory() != nullptr);
    services.begin_search();
    result_ = check_branch_load(prepared_, {display_of(services), services.interrupt, &checkpoint});
    checkpoint_line_ = checkpoint.line();
    proof = certify_load(services.certificate, prepared_, result_, {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    describe(prepared_, result_, *this);
  }

  void tell(Facts& facts) const override {
    tell_branch_load(prepared_, result_, nullptr, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  PreparedBranchLoad prepared_;
  BranchLoadResult result_;
  std::string checkpoint_line_;
};

class ClosureLoadPaving final : public LoadPavingAnswer {
 public:
  ClosureLoadPaving(Request request, double model_seconds, const AskLoadPaving& asked,
                    const Services& services)
      : prepared_(prepare_branch_load(std::move(request), model_seconds, asked.load, asked.search,
                                      watch_of(services, asked.search))),
        volumes_(prepared_.closure().problem) {
    const PreparedSearch& preparation = prepared_.closure().preparation;
    PavingOptions options = resolve_paving(asked.resolution, asked.search, preparation);
    options.encloses_determinants = false;
    Pictures pictures(services.pictures, options, preparation, word_of_stand_in,
                      ", load " + prepared_.load);
    LinesFile lines(services.lines);
    const auto write = [&](const Json& line) {
      if (!lines.is_wanted()) return;
      // A line that cannot be written ends the search, with the reason that the file has.
      if (!(lines.stream() << report_text(line) << '\n')) lines.finish();
    };
    write(json_forces_header(prepared_.words(), options.resolution));
    const auto listen = [&](std::size_t, std::span<const Interval> box, ForceClaim held) {
      volumes_.add(box, held);
      write(json_forces_box(prepared_.words(), box, held));
      if (services.on_force_box) services.on_force_box(held, box);
    };
    pave(services, options.resolution, listen, pictures.observers());
    write_beside([&] {
      write(json());
      lines.finish();
    });
    write_beside([&] { pictures.draw(volumes_.by_stand_in()); });
    map_ = pictures.map();
  }

  void tell(Facts& facts) const override {
    tell_branch_load(prepared_, result_, &volumes_, facts);
    proof.tell(facts);
    facts.say("map", map_);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  void pave(const Services& services, double resolution, const PieceForceListener& listener,
            const std::vector<Observer*>& pictures) {
    SearchCheckpoint checkpoint(services.checkpoint,
                                [&] { return checkpointed_question(prepared_, resolution); });
    services.begin_search();
    SearchDisplay display(display_of(services));
    std::vector<Observer*> watching = present({display.observer()});
    watching.insert(watching.end(), pictures.begin(), pictures.end());
    Observers observers(std::move(watching));
    result_ = pave_branch_load(prepared_, resolution,
                               {display_of(services), services.interrupt, &checkpoint}, listener,
                               &observers);
    checkpoint_line_ = checkpoint.line();
    describe(prepared_, result_, *this);
    proof = certify_load_paving(services.certificate, prepared_, result_,
                                {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    feasible = volumes_.fraction(ForceClaim::kFeasible);
    infeasible = volumes_.fraction(ForceClaim::kInfeasible);
    undecided = volumes_.fraction(ForceClaim::kUndecided);
    outside = volumes_.fraction(ForceClaim::kOutside);
  }

  PreparedBranchLoad prepared_;
  ForceVolumes volumes_;
  BranchLoadResult result_;
  std::string map_, checkpoint_line_;
};

/// Along way-points: stretches, and no boxes.
class ClosureWayLoadPaving final : public LoadPavingAnswer {
 public:
  ClosureWayLoadPaving(Request request, double model_seconds, const AskLoadPaving& asked,
                       const Services& services)
      : lines_(services.lines),
        resolution_(asked.resolution.empty() ? kPathResolution : read_resolution(asked.resolution)),
        prepared_(prepare_branch_load(std::move(request), model_seconds, asked.load, asked.search,
                                      watch_of(services, asked.search))) {
    WayPictures pictures(services.pictures);
    services.begin_search();
    pave(services);
    describe(prepared_, result_, *this);
    proof = certify_load_paving(services.certificate, prepared_, result_,
                                {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    variables.clear();
    const Request& asked_about = prepared_.branch.way().request;
    const Trajectory& way = *prepared_.branch.trajectory();
    stretches = stretches_of_load(way, parts_);
    write_beside([this] { write_stretches(stretches, json(), lines_); });
    write_beside([&] {
      pictures.draw({fmt::format("{}, {}, load {}", asked_about.model.name, asked_about.motion.name,
                                 prepared_.load),
                     way, parts_, word_of_stand_in});
    });
  }

  void tell(Facts& facts) const override {
    tell_branch_load(prepared_, result_, nullptr, facts);
    tell_force_stretches(*prepared_.branch.trajectory(), resolution_, parts_, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  /// The first variable of a piece is s, and a paving halves no other.
  void pave(const Services& services) {
    SearchCheckpoint checkpoint(
        services.checkpoint, [&] { return checkpointed_question(prepared_, resolution_); }, true);
    SearchDisplay display(display_of(services));
    const auto listen = [this](std::size_t piece, std::span<const Interval> box, ForceClaim held) {
      parts_.push_back({stand_in(held), {}, {piece, box[0].lo}, {piece, box[0].hi}});
    };
    result_ = pave_branch_load(prepared_, resolution_,
                               {display_of(services), services.interrupt, &checkpoint}, listen,
                               display.observer());
    parts_ = stretches_in_order(std::move(parts_), prepared_.branch.pieces(), {});
    checkpoint_line_ = checkpoint.line();
  }

  LinesFile lines_;
  double resolution_;
  PreparedBranchLoad prepared_;
  BranchLoadResult result_;
  std::vector<PathStretch> parts_;  ///< with claims that stand for those about forces
  std::string checkpoint_line_;
};

}  // namespace

std::unique_ptr<LoadAnswer> answer_closure(Request request, double model_seconds,
                                           const AskLoad& asked, const Services& services) {
  return std::make_unique<ClosureLoad>(std::move(request), model_seconds, asked, services);
}

std::unique_ptr<LoadPavingAnswer> answer_closure(Request request, double model_seconds,
                                                 const AskLoadPaving& asked,
                                                 const Services& services) {
  return std::make_unique<ClosureLoadPaving>(std::move(request), model_seconds, asked, services);
}

std::unique_ptr<LoadPavingAnswer> answer_closure_way(Request request, double model_seconds,
                                                     const AskLoadPaving& asked,
                                                     const Services& services) {
  return std::make_unique<ClosureWayLoadPaving>(std::move(request), model_seconds, asked, services);
}

}  // namespace regulus::detail
