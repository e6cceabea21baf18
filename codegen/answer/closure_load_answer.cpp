// SPDX-License-Identifier: GPL-3.0-or-later
// Do the motors of a closure hold a load within their limits, and where?
#include <nlohmann/json.hpp>

#include "codegen/answer/closure_answer.hpp"
#include "codegen/answer/lines_file.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/picture/pictures.hpp"
#include "codegen/answer/report/paving_options.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/question/closure/branch_load.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus {
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
    SearchCheckpoint checkpoint(services.checkpoint,
                                [&] { return checkpointed_question(prepared_, std::nullopt); });
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
    const auto listen = [&](std::span<const Interval> box, ForceClaim held) {
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
  [[nodiscard]] std::string about_files() const override { return checkpoint_line_; }

 private:
  void pave(const Services& services, double resolution, const ForceListener& listener,
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

}  // namespace regulus
