// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/closure_answer.hpp"

#include "codegen/answer/box_listener.hpp"
#include "codegen/answer/lines_file.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/page/paving_tree.hpp"
#include "codegen/answer/picture/pictures.hpp"
#include "codegen/answer/report/paving_options.hpp"
#include "codegen/answer/report/paving_report.hpp"
#include "codegen/answer/report/paving_writer.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/search_checkpoint.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/closure/closure_certificate.hpp"
#include "codegen/question/closure/closure_claims.hpp"
#include "codegen/question/closure/closure_report.hpp"
#include "codegen/question/closure/paving_certificate.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// A checkpoint calls the search of the branch by this name.
constexpr const char* kTree = "tree";

/// The answer for a mechanism whose configuration is a solution of equations.
class ClosureCheck final : public CheckAnswer {
 public:
  ClosureCheck(Request request, double model_seconds, const AskCheck& asked,
               const Services& services)
      : search_(asked.search),
        prepared_(prepare_closure(std::move(request), model_seconds, search_,
                                  watch_of(services, search_))) {
    services.begin_search();
    SearchDisplay display(display_of(services));
    SearchCheckpoint checkpoint(services.checkpoint,
                                [&] { return checkpointed_question(prepared_, search_, 0); });
    found_ =
        check_closure(prepared_, search_, watch_of(services, search_),
                      {display.observer(), {}, {checkpoint.file(), checkpoint.interval(), kTree}});
    result = check_result(prepared_, found_);
    proof = certify_check(services.certificate, prepared_, found_, {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    write_beside([&] { checkpoint.finish(result.stopped_by.has_value()); });
    checkpoint_line_ = checkpoint.line();
    for (const VariableLabel& variable : prepared_.preparation.labels.variables)
      variables.push_back(variable.name);
  }

  [[nodiscard]] std::string claim() const override { return describe_claim(prepared_, found_); }
  void tell(Facts& facts) const override {
    tell_closure(prepared_, search_, found_, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  SearchOptions search_;
  PreparedClosure prepared_;
  ClosureFinding found_;
  std::string checkpoint_line_;
};

/// The answer says where the branch is certain, and where it ends. Boxes are told when they are linked.
class ClosurePaving final : public PavingAnswer {
 public:
  ClosurePaving(Request request, double model_seconds, const AskPaving& asked,
                const Services& services)
      : search_(asked.search),
        prepared_(prepare_closure(std::move(request), model_seconds, search_,
                                  watch_of(services, search_))),
        options_(resolve_paving(asked.resolution, search_, prepared_.preparation)),
        problem_(prepared_.preparation.problem()),
        volumes_(problem_) {
    options_.encloses_determinants = false;
    for (const VariableLabel& variable : prepared_.preparation.labels.variables)
      variables.push_back(variable.name);
    LinesFile lines(services.lines);
    Pictures pictures(services.pictures, options_, prepared_.preparation);
    BoxListener listener(services, problem_, 0);
    std::optional<PavingWriter> writer;
    if (lines.is_wanted())
      writer.emplace(lines.stream(), prepared_.preparation, options_,
                     [&listener] { listener.ask_for_end(); });
    services.begin_search();
    SearchDisplay display(display_of(services));
    SearchCheckpoint checkpoint(services.checkpoint, [&] {
      return checkpointed_question(prepared_, search_, options_.resolution);
    });
    found_ =
        pave_closure(prepared_, search_, options_.resolution, watch_of(services, search_),
                     {display.observer(), {}, {checkpoint.file(), checkpoint.interval(), kTree}});
    proof = certify_paving(services.certificate, prepared_, found_, {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    write_beside(
        [&] { checkpoint.finish(check_result(prepared_, found_).stopped_by.has_value()); });
    checkpoint_line_ = checkpoint.line();
    std::optional<PavingTree> tree;
    if (services.tree != nullptr) tree.emplace(problem_, 0);
    std::vector<Observer*> watching =
        present({&volumes_, &listener, writer ? &*writer : nullptr, tree ? &*tree : nullptr});
    for (Observer* picture : pictures.observers()) watching.push_back(picture);
    Observers observers(std::move(watching));
    tell_boxes(prepared_, found_, observers);
    listener.rethrow();
    if (tree) *services.tree = tree->text();
    conclude();
    write_beside([&] {
      if (writer) writer->finish(json(), lines.name());
      lines.finish();
    });
    write_beside([&] { pictures.draw(volumes_); });
  }

  [[nodiscard]] Json header() const override {
    return json_paving_header(prepared_.preparation, options_);
  }
  void tell(Facts& facts) const override {
    tell_paving(prepared_.preparation, prepared_.request, search_, options_, volumes_, result,
                facts);
    tell_branch(prepared_, found_.searched.links, found_.folds, facts);
    tell_below(prepared_, nullptr, found_.threshold, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  void conclude() {
    result = check_result(prepared_, found_);
    const auto fraction = [this](Claim claim) { return volumes_.fraction(volumes_.of(claim)); };
    free = fraction(Claim::kFree);
    undecided = fraction(Claim::kUndecided);
    outside = fraction(Claim::kOutside);
    singular = fraction(Claim::kSingular);
    unreachable = Interval(0.0);
  }

  SearchOptions search_;
  PreparedClosure prepared_;
  PavingOptions options_;
  Problem problem_;
  Volumes volumes_;
  ClosureFinding found_;
  std::string checkpoint_line_;
};

}  // namespace

std::unique_ptr<CheckAnswer> answer_closure(Request request, double model_seconds,
                                            const AskCheck& asked, const Services& services) {
  return std::make_unique<ClosureCheck>(std::move(request), model_seconds, asked, services);
}

std::unique_ptr<PavingAnswer> answer_closure(Request request, double model_seconds,
                                             const AskPaving& asked, const Services& services) {
  return std::make_unique<ClosurePaving>(std::move(request), model_seconds, asked, services);
}

}  // namespace regulus::detail
