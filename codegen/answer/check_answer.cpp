// SPDX-License-Identifier: GPL-3.0-or-later
// Has the motion a singular pose?
#include "codegen/answer/ask.hpp"
#include "codegen/answer/certificate/certificate_file.hpp"
#include "codegen/answer/closure_answer.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/refusals.hpp"
#include "codegen/answer/report/kept_search.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/answer/report/search_checkpoint.hpp"
#include "codegen/question/analysis/least_singular.hpp"
#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/way/margin_checkpoint.hpp"
#include "codegen/question/way/read_trajectory.hpp"
#include "codegen/question/way/sides_search.hpp"
#include "codegen/question/way/trajectory_certificate.hpp"
#include "codegen/question/way/trajectory_report.hpp"
#include "codegen/support/stopwatch.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

/// True if the compiler's work is kept for a later run and no end was requested.
bool is_worth_waiting(const PreparedSearch& preparation, const Result& result) {
  return preparation.cache != name(CacheUse::kOff) &&
         (!result.stopped_by || *result.stopped_by == Reason::kBoxBudget ||
          *result.stopped_by == Reason::kStalled);
}

/// True if the search has ended by itself, and more of it would not help.
bool is_undecided(const Result& result) {
  return result.reason == Reason::kUndefined || result.reason == Reason::kWidth ||
         result.reason == Reason::kStalled || result.reason == Reason::kUncertainty ||
         result.reason == Reason::kSeemsSingular;
}

/// The answer for a motion whose poses are a box or follow a formula.
class VarietyCheck final : public CheckAnswer {
 public:
  VarietyCheck(const AskCheck& asked, const Services& services)
      : search_(asked.search), prepared_(prepare(asked.model, search_, watch_of(services))) {
    const Settings settings = settings_of(prepared_, search_, services.interrupt);
    services.begin_search();
    SearchCheckpoint checkpoint(services.checkpoint,
                                [this] { return json_kept_question(prepared_, search_); });
    CertificateFile certificate(services.certificate, prepared_, services.shard_size);
    SearchDisplay display(display_of(services));
    Observers observers(present({certificate.observer(), display.observer()}));
    KeptSearch kept(checkpoint.file(), "search", checkpoint.interval());
    result = kept.run(prepared_, search_, settings, observers);
    certificate.finish(result);
    const bool can_continue = result.verdict == Verdict::kPossibleProblem && result.stopped_by;
    write_beside([&] { checkpoint.finish(can_continue); });
    proof = certificate.status();
    if (is_undecided(result) && !prepared_.text) decide_by_sides(services, display.observer());
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    if (!prepared_.text) nearest_ = nearest_singular(prepared_, result);
    checkpoint_line_ = checkpoint.line();
    for (const VariableLabel& variable : prepared_.labels.variables)
      variables.push_back(variable.name);
  }

  [[nodiscard]] std::string claim() const override { return detail::claim(prepared_, result); }
  void tell(Facts& facts) const override {
    tell_report(prepared_, search_, result, nearest_, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }
  [[nodiscard]] Rest wait_for_rest(const std::atomic<bool>& interrupted) override {
    LateCompilation* const late = prepared_.late.get();
    if (late == nullptr) return {};
    if (late->is_compiling() && !(is_worth_waiting(prepared_, result) && late->wait(interrupted)))
      return {.is_at_work = true, .note = ""};
    if (late->failure().empty()) return {};
    return {.is_at_work = false,
            .note = "compiler   not available, so the whole search was interpreted: " +
                    late->failure() + '\n'};
  }

 private:
  /// Follows the matrix on both sides where atan2 jumps on the motion.
  void decide_by_sides(const Services& services, Observer* display) {
    const CutSides sides(prepared_.stages->request());
    if (sides.is_empty()) return;
    const auto decision =
        search_sides(sides, prepared_, result, search_, services.interrupt, display);
    if (!decision) return;
    result = decision->result;
    proof = certify_sides(services.certificate, sides, prepared_, *decision,
                          {nullptr, services.shard_size});
    prepared_.labels.matrix_notes.push_back(sides.note());
  }

  SearchOptions search_;
  PreparedSearch prepared_;
  std::optional<LeastSingular> nearest_;
  std::string checkpoint_line_;
};

/// The answer for a motion along way-points has no `variables`.
class WayCheck final : public CheckAnswer {
 public:
  WayCheck(Request request, double model_seconds, const AskCheck& asked, const Services& services)
      : search_(asked.search) {
    SearchDisplay display(display_of(services));
    SearchCheckpoint checkpoint(
        services.checkpoint, [&] { return checkpointed_question(request, search_); }, true);
    check_ =
        check_trajectory(std::move(request), model_seconds, search_, !services.certificate.empty(),
                         {services.interrupt, display.observer(), &checkpoint});
    proof = certify_trajectory(services.certificate, check_, {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    write_beside([&] {
      checkpoint.finish(check_.can_continue && check_.verdict == Verdict::kPossibleProblem);
    });
    checkpoint_line_ = checkpoint.line();
    if (check_.deciding) result = check_.deciding->result;
    result.verdict = check_.verdict;
    result.reason = check_.reason;
    result.statistics = check_.path.statistics;
  }

  [[nodiscard]] std::string claim() const override { return describe_trajectory_claim(check_); }
  void tell(Facts& facts) const override {
    tell_trajectory(check_, search_, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  SearchOptions search_;
  TrajectoryCheck check_;
  std::string checkpoint_line_;
};

}  // namespace

std::unique_ptr<CheckAnswer> ask(const AskCheck& asked, const Services& services) {
  refuse_services(Kind::kCheck, asked.model, asked.search, services);
  set_outputs_aside(asked.model, asked.search, services);
  Stopwatch watch;
  std::optional<Request> along = read_trajectory(asked.model, watch_of(services, asked.search));
  if (!along) {
    std::optional<Request> closed = read_closure(asked.model, watch_of(services, asked.search));
    if (!closed) return std::make_unique<VarietyCheck>(asked, services);
    return answer_closure(std::move(*closed), watch.lap(), asked, services);
  }
  if (along->model.closure)
    return answer_closure_way(std::move(*along), watch.lap(), asked, services);
  services.begin_search();
  return std::make_unique<WayCheck>(std::move(*along), watch.lap(), asked, services);
}

}  // namespace regulus::detail
